// SPDX-License-Identifier: BSD-3-Clause
// Contact sensor (bumper): contacts of a link, with positions and forces.
#include <algorithm>
#include <utility>

#include "sensors/kinds.hpp"

namespace bubblesim {
namespace {

class ContactSensor final : public Sensor {
 public:
  ContactSensor(ContactDescription description, ObjectId link)
      : Sensor(ContactReading{}), description_(std::move(description)), link_(link) {}

 private:
  void measure(const MeasurementContext& moment, Measurement& measurement) override {
    std::vector<Contact> contacts = moment.world.contacts(link_);
    const auto foreign = [this](const Contact& contact) { return !watches(description_, contact.collision); };
    contacts.erase(std::remove_if(contacts.begin(), contacts.end(), foreign), contacts.end());
    measurement = ContactReading{std::move(contacts)};
  }

  ContactDescription description_;
  ObjectId link_;
};

}  // namespace

std::unique_ptr<Sensor> make_kind(const ContactDescription& description, const SensorSite& site) {
  return std::make_unique<ContactSensor>(description, site.world.tree().at(site.id).parent);
}

}  // namespace bubblesim
