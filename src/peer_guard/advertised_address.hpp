// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/socket.h>

#include <string>

namespace bubblesim {

/// Lets roscpp advertise `localhost` if only this machine reaches the master and the user chose no address. Nodes
/// elsewhere do not know such a master, but roscpp would listen on all addresses for them. Call it before ros::init().
void stay_on_this_machine(int argc, const char* const* argv);

/// While it exists, sockets that this thread binds to all addresses are bound to the node's advertised address instead:
/// ros::start() then opens its XML-RPC and TCPROS ports on that address only. It acts if the user chose the address, by
/// ROS_HOSTNAME, ROS_IP, `__hostname:=` or `__ip:=`. The sockets stay bound to all addresses if the name has several
/// addresses, or a loopback address that other machines do not know (as in Debian's /etc/hosts), and, with a warning,
/// if the name does not belong to this machine. Make it after ros::init().
class AdvertisedAddress {
 public:
  AdvertisedAddress();
  ~AdvertisedAddress();
  AdvertisedAddress(const AdvertisedAddress&) = delete;
  AdvertisedAddress& operator=(const AdvertisedAddress&) = delete;

  /// Binds a socket to the advertised address, with the port of `wildcard`; false if the socket is to be bound as
  /// requested.
  bool bind_instead(int descriptor, const sockaddr* wildcard);

 private:
  const std::string host_;  // empty if the user did not choose one
  bool warned_ = false;
};

}  // namespace bubblesim
