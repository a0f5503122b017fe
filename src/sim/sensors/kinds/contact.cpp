// SPDX-License-Identifier: BSD-3-Clause
// Contact sensor (bumper): contacts of a link, with positions and forces.
#include <algorithm>
#include <utility>

#include "bubblesim/nearest_names.hpp"
#include "sensors/define.hpp"

namespace bubblesim {
namespace {

class ContactSensor final : public Sensor {
 public:
  ContactSensor(ContactDescription description, ObjectId link)
      : Sensor(ContactReading{}), description_(std::move(description)), link_(link) {}

 private:
  void measure(const MeasurementContext& context, Measurement& measurement) override {
    std::vector<Contact> contacts = context.world.measurements().contacts(link_);
    const auto foreign = [this](const Contact& contact) { return !watches(description_, contact.collision); };
    contacts.erase(std::remove_if(contacts.begin(), contacts.end(), foreign), contacts.end());
    measurement = ContactReading{std::move(contacts)};
  }

  ContactDescription description_;
  ObjectId link_;
};

}  // namespace

namespace {

/// Some files have names with the scopes of the collision: model::link::collision.
std::string without_scope(const std::string& name) {
  const std::size_t scope = name.rfind("::");
  return scope == std::string::npos ? name : name.substr(scope + 2);
}

}  // namespace

const MemberTable& ContactDescription::members() {
  static const MemberTable table = member_table<ContactDescription>(
      "ContactDescription", "Measures the contacts of its link.",
      {
          member<&ContactDescription::collisions>("collisions", "", "names of collisions of the link; empty: all"),
      });
  return table;
}

const MemberTable& ContactPoint::members() {
  static const MemberTable table = member_table<ContactPoint>(
      "ContactPoint", "Contact point of two shapes; world axes.",
      {
          member<&ContactPoint::position>("position", "m", "of the point"),
          member<&ContactPoint::normal>("normal", "", "direction in which the other shape pushes"),
          member<&ContactPoint::depth>("depth", "m", "penetration depth"),
          member<&ContactPoint::force>("force", "N", "in the physics substep of their last contact"),
      });
  return table;
}

const MemberTable& Contact::members() {
  static const MemberTable table = member_table<Contact>(
      "Contact", "A contact of one of the link's shapes with another shape during the last step.",
      {
          member<&Contact::collision>("collision", "", "name of the link's shape"),
          member<&Contact::other_link>("other", "", "handle of the other link"),
          member<&Contact::other_collision>("other_collision", "", "name of that link's shape"),
          member<&Contact::force>("force", "N", "on the sensor's link in world axes, the mean over the step"),
          member<&Contact::points>("points", "", "contact points in the physics substep of their last contact"),
      });
  return table;
}

const MemberTable& ContactReading::members() {
  static const MemberTable table =
      member_table<ContactReading>("ContactReading", "Contacts of a link.",
                                   {
                                       member<&ContactReading::contacts>("contacts", "", "one for each pair of shapes"),
                                   });
  return table;
}

class ContactKind final : public SensorDefinitionOf<ContactDescription, ContactReading> {
 public:
  ContactKind() : SensorDefinitionOf("contact sensor", {"contact"}) {
    reader = "contacts";
    elements = R"(
  contact none
    collision text required
    topic text
)";
    observe("contacts", "", "their number", Sizes{},
            [](const ContactReading& reading, Row& row) { row.put(static_cast<double>(reading.contacts.size())); });
    observe("contact_force", "N", "the sum of the forces on the link, world axes", Sizes{3},
            [](const ContactReading& reading, Row& row) {
              Vector3 sum;
              for (const Contact& contact : reading.contacts) sum += contact.force;
              row.put(sum);
            });
  }

  std::optional<ContactDescription> read(SensorElement& sensor) const override {
    ContactDescription description;
    for (const std::string& collision : sensor.strings("contact/collision")) {
      description.collisions.push_back(without_scope(collision));
    }
    return description;
  }

  void check(SensorCheck& check, const ContactDescription& contact) const override {
    if (check.link() == nullptr) return;
    std::vector<std::string> names;
    for (const CollisionDescription& collision : check.link()->collisions) names.push_back(collision.name);
    for (const std::string& name : contact.collisions) {
      if (std::find(names.begin(), names.end(), name) != names.end()) continue;
      check.report("'" + name + "' is not a collision of this link" + did_you_mean(name, names));
    }
  }

  std::unique_ptr<Sensor> make(const ContactDescription& description, const SensorSite& site) const override {
    return std::make_unique<ContactSensor>(description, site.world.tree().at(site.id).carrier);
  }
};

template std::unique_ptr<SensorDefinition> define<ContactKind>();

}  // namespace bubblesim
