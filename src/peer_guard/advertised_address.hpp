// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/socket.h>

#include <string>

namespace bubblesim {

/// While it lives, sockets that this thread binds to all addresses of the machine are bound to the one that the node
/// advertises instead: ros::start() then opens its XML-RPC and TCPROS ports there alone. It acts when the user chose
/// the address, by ROS_HOSTNAME, ROS_IP, `__hostname:=` or `__ip:=`. All addresses stay open to a name that has several
/// of them or, as Debian's /etc/hosts has it, a loopback address that other machines do not know; and, with a warning,
/// to a name that is none of this machine. Make it after ros::init().
class AdvertisedAddress {
 public:
  AdvertisedAddress();
  ~AdvertisedAddress();
  AdvertisedAddress(const AdvertisedAddress&) = delete;
  AdvertisedAddress& operator=(const AdvertisedAddress&) = delete;

  /// Binds a socket to the advertised address, with the port of `wildcard`; false when it is to be bound as asked.
  bool bind_instead(int descriptor, const sockaddr* wildcard);

 private:
  const std::string host_;  // empty when the user chose none
  bool warned_ = false;
};

}  // namespace bubblesim
