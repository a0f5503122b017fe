// SPDX-License-Identifier: BSD-3-Clause
#include "physics/contacts/contact_memory.hpp"

#include <algorithm>
#include <utility>

#include "physics/ode/ode_math.hpp"
#include "physics/parts/collider.hpp"
#include "scene/fnv1a.hpp"

namespace bubblesim {
namespace {

// A load that changes by more than this factor in a substep is that of an impact.
constexpr double kSteadyFactor = 1.5;
constexpr int kSteadyAge = 2;  // substeps

std::pair<int, int> numbers(const Collider* first, const Collider* second) { return {first->number, second->number}; }

bool both_sleep(const RememberedPair& pair) {
  const auto rests = [](const Collider* shape) {
    dBodyID body = shape->link->body.get();
    return body == nullptr || dBodyIsEnabled(body) == 0;
  };
  return rests(pair.first) && rests(pair.second);
}

/// The mean velocity of the moving bodies of a pair, with which its points move along.
Vector3 shift(const FoundPair& pair) {
  const Vector3 first = to_vector(dBodyGetLinearVel(pair.first->link->body.get()));
  dBodyID second = pair.second->link->body.get();
  return second == nullptr ? first : (first + to_vector(dBodyGetLinearVel(second))) / 2;
}

/// Halfway from the last limit to the normal force, which converges where friction lowers the normal force by
/// up to three times as much, and where it raises it by less.
double next_limit(const FoundContact& point, double normal) {
  return point.limit.relied == FrictionLimit::kNone ? normal : (normal + point.limit.relied) / 2;
}

}  // namespace

void ContactMemory::clear() {
  pairs.clear();
  points.clear();
}

void ContactMemory::add_to(Fnv1a& hash) const {
  for (const RememberedPair& pair : pairs) {
    hash.add(static_cast<std::uint64_t>(pair.first->number));
    hash.add(static_cast<std::uint64_t>(pair.second->number));
    hash.add(static_cast<std::uint64_t>(pair.age));
    hash.add(&pair.load_before, 1);
    for (std::size_t i = pair.begin; i < pair.begin + static_cast<std::size_t>(pair.count); ++i) {
      const RememberedPoint& point = points[i];
      const double values[] = {point.position.x(), point.position.y(), point.position.z(), point.normal,
                               point.friction.x(), point.friction.y(), point.friction.z(), point.limit};
      hash.add(values, 8);
      if (point.torque == Vector3::Zero()) continue;
      const double torque[] = {point.torque.x(), point.torque.y(), point.torque.z()};
      hash.add(torque, 3);
    }
  }
}

const RememberedPair* ContactLookup::pair(const FoundPair& pair) {
  const std::vector<RememberedPair>& pairs = memory_.pairs;
  const auto asked = numbers(pair.first, pair.second);
  while (next_ < pairs.size() && numbers(pairs[next_].first, pairs[next_].second) < asked) ++next_;
  if (next_ == pairs.size() || numbers(pairs[next_].first, pairs[next_].second) != asked) return nullptr;
  return &pairs[next_];
}

bool is_settled(const RememberedPair& pair) {
  return pair.age >= kSteadyAge && pair.load > 0 && pair.load < kSteadyFactor * pair.load_before &&
         pair.load_before < kSteadyFactor * pair.load;
}

ExpectedContacts expect(const ContactMemory& memory, const RememberedPair& remembered, const FoundPair& pair,
                        const FoundContact* points, double step) {
  ExpectedContacts expected;
  if (remembered.count == 0) return expected;
  const Vector3 moved = shift(pair) * step;
  double sum = 0;
  for (int i = 0; i < pair.count; ++i) {
    const Vector3 position = to_vector(points[i].contact.geom.pos) - moved;
    const RememberedPoint* nearest = &memory.points[remembered.begin];
    double least = (nearest->position - position).squaredNorm();
    for (std::size_t j = 1; j < static_cast<std::size_t>(remembered.count); ++j) {
      const RememberedPoint& other = memory.points[remembered.begin + j];
      const double distance = (other.position - position).squaredNorm();
      if (distance >= least) continue;
      least = distance;
      nearest = &other;
    }
    expected[static_cast<std::size_t>(i)] = {nearest->normal, nearest->friction, nearest->torque, nearest->limit};
    sum += nearest->normal;
  }
  if (pair.count == remembered.count || sum <= 0) return expected;
  // Points came or went: the others share the same load.
  for (ExpectedContact& contact : expected) {
    contact.normal *= remembered.load / sum;
    contact.friction *= remembered.load / sum;
    contact.torque *= remembered.load / sum;
    contact.limit *= remembered.load / sum;
  }
  return expected;
}

void forget_contacts(ContactMemory& memory, const std::function<bool(const Collider&)>& belongs) {
  std::vector<RememberedPair>& pairs = memory.pairs;
  // Their points stay until the next substep; nothing refers to them.
  pairs.erase(std::remove_if(pairs.begin(), pairs.end(),
                             [&](const RememberedPair& pair) { return belongs(*pair.first) || belongs(*pair.second); }),
              pairs.end());
}

void remember_contacts(const FoundContacts& found, ContactMemory& memory, ContactMemory& before) {
  std::swap(before, memory);
  memory.clear();
  ContactLookup lookup(before);
  for (const FoundPair& pair : found.pairs) {
    RememberedPair now{pair.first, pair.second, memory.points.size(), pair.count};
    if (const RememberedPair* last = lookup.pair(pair)) {
      now.age = std::min(last->age + 1, kSteadyAge);
      now.load_before = last->load;
    }
    for (int i = 0; i < pair.count; ++i) {
      const FoundContact& point = found.points[pair.begin + static_cast<std::size_t>(i)];
      const Vector3 normal = to_vector(point.contact.geom.normal);
      const double load = std::max(point.force.dot(normal), 0.0);
      memory.points.push_back({to_vector(point.contact.geom.pos), normal, load,
                               point.force - normal * point.force.dot(normal), point.torque, next_limit(point, load)});
      now.load += load;
    }
    memory.pairs.push_back(now);
  }
}

void sort_by_sleep(ContactMemory& memory, ContactMemory& asleep) {
  const std::array<ContactMemory, 2> before = {std::exchange(memory, {}), std::exchange(asleep, {})};
  std::vector<std::pair<RememberedPair, const ContactMemory*>> all;
  for (const ContactMemory& from : before) {
    for (const RememberedPair& pair : from.pairs) all.emplace_back(pair, &from);
  }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return numbers(a.first.first, a.first.second) < numbers(b.first.first, b.first.second);
  });
  for (auto& [pair, from] : all) {
    ContactMemory& to = both_sleep(pair) ? asleep : memory;
    const auto begin = from->points.begin() + static_cast<std::ptrdiff_t>(pair.begin);
    pair.begin = to.points.size();
    to.points.insert(to.points.end(), begin, begin + pair.count);
    to.pairs.push_back(pair);
  }
}

}  // namespace bubblesim
