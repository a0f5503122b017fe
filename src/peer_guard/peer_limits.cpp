// SPDX-License-Identifier: BSD-3-Clause
// Each function here replaces a function of xmlrpcpp or cpp_common, and calls the original.
#include "peer_limits.hpp"

#include <dlfcn.h>
#include <ros/header.h>
#include <unistd.h>
#include <xmlrpcpp/XmlRpcException.h>
#include <xmlrpcpp/XmlRpcServerConnection.h>
#include <xmlrpcpp/XmlRpcSocket.h>
#include <xmlrpcpp/XmlRpcUtil.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>

namespace bubblesim {
namespace {

/// The definition that the loader would use without ours. A member function takes its object first.
template <class Function>
Function* replaced(const char* symbol) {
  void* found = dlsym(RTLD_NEXT, symbol);
  if (found == nullptr) throw std::runtime_error(std::string("unknown version of roscpp: missing symbol ") + symbol);
  return reinterpret_cast<Function*>(found);
}

using XmlRpc::XmlRpcServerConnection;
using XmlRpc::XmlRpcValue;

auto* replaced_from_xml() {
  static auto* const function = replaced<bool(XmlRpcValue*, const std::string&, int*)>(
      "_ZN6XmlRpc11XmlRpcValue7fromXmlERKNSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEEPi");
  return function;
}

auto* replaced_find_tag() {
  static auto* const function = replaced<bool(const char*, const std::string&, int*)>(
      "_ZN6XmlRpc10XmlRpcUtil7findTagEPKcRKNSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEEPi");
  return function;
}

auto* replaced_execute_method() {
  static auto* const function = replaced<bool(XmlRpcServerConnection*, const std::string&, XmlRpcValue&, XmlRpcValue&)>(
      "_ZN6XmlRpc22XmlRpcServerConnection13executeMethodERKNSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEERNS_"
      "11XmlRpcValueESA_");
  return function;
}

auto* replaced_parse() {
  static auto* const function = replaced<bool(ros::Header*, std::uint8_t*, std::uint32_t, std::string&)>(
      "_ZN3ros6Header5parseEPhjRNSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEE");
  return function;
}

/// Leaves all values of a parameter at once. xmlrpcpp itself goes on after a missing tag, and looks for the next one up
/// to the end of the request: for each of a million values, or at each level.
struct Unreadable {};

thread_local int depth = 0;

class OneDeeper {
 public:
  OneDeeper() { ++depth; }
  ~OneDeeper() { --depth; }
  OneDeeper(const OneDeeper&) = delete;
  OneDeeper& operator=(const OneDeeper&) = delete;
};

bool is_array(const XmlRpcValue& value) { return value.getType() == XmlRpcValue::TypeArray; }

/// xmlrpcpp would call the outer one again for each nested one.
void refuse_nested_multicall(XmlRpcValue& params) {
  if (!is_array(params) || params.size() != 1 || !is_array(params[0])) return;
  for (int i = 0; i < params[0].size(); ++i) {
    XmlRpcValue& call = params[0][i];
    if (!call.hasMember("methodName")) continue;
    XmlRpcValue& name = call["methodName"];
    if (name.getType() == XmlRpcValue::TypeString && static_cast<std::string&>(name) == "system.multicall") {
      throw XmlRpc::XmlRpcException("system.multicall: cannot call itself");
    }
  }
}

void refuse_unreadable(XmlRpcValue& params) {
  if (!is_array(params)) return;
  for (int i = 0; i < params.size(); ++i) {
    if (!params[i].valid()) {
      throw XmlRpc::XmlRpcException("parameter " + std::to_string(i + 1) +
                                    " cannot be read, or nests values more than " + std::to_string(kDeepestXmlRpc) +
                                    " deep");
    }
  }
}

/// Whether the lengths in a TCPROS header, one before each field, stay within it.
bool lengths_fit(const std::uint8_t* buffer, std::uint32_t size) {
  std::uint32_t at = 0;
  while (at < size) {
    std::uint32_t length = 0;
    if (size - at < sizeof(length)) return false;
    std::memcpy(&length, buffer + at, sizeof(length));
    at += sizeof(length);
    if (length > size - at) return false;
    at += length;
  }
  return true;
}

}  // namespace

void check_peer_limits() {
  replaced_from_xml();
  replaced_find_tag();
  replaced_execute_method();
  replaced_parse();
}

}  // namespace bubblesim

bool XmlRpc::XmlRpcSocket::nbRead(int socket, std::string& s, bool* eof) {
  *eof = false;
  std::array<char, 1 << 14> piece{};
  for (;;) {
    if (s.size() > bubblesim::kLargestXmlRpc) {
      errno = EMSGSIZE;
      return false;
    }
    const ssize_t got = read(socket, piece.data(), piece.size());
    if (got > 0) {
      s.append(piece.data(), static_cast<std::size_t>(got));
    } else if (got == 0) {
      *eof = true;
      return true;
    } else if (errno != EINTR) {
      return errno == EAGAIN || errno == EINPROGRESS;
    }
  }
}

bool XmlRpc::XmlRpcValue::fromXml(const std::string& valueXml, int* offset) {
  using namespace bubblesim;
  if (depth == kDeepestXmlRpc) throw Unreadable{};
  const int start = *offset;
  const bool is_outermost = depth == 0;
  const OneDeeper deeper;
  if (!is_outermost) return replaced_from_xml()(this, valueXml, offset);
  try {
    return replaced_from_xml()(this, valueXml, offset);
  } catch (const Unreadable&) {
    clear();
    *offset = start;
    return false;
  }
}

bool XmlRpc::XmlRpcUtil::findTag(const char* tag, const std::string& xml, int* offset) {
  const bool is_found = bubblesim::replaced_find_tag()(tag, xml, offset);
  if (!is_found && bubblesim::depth > 0) throw bubblesim::Unreadable{};
  return is_found;
}

bool XmlRpc::XmlRpcServerConnection::executeMethod(const std::string& methodName, XmlRpcValue& params,
                                                   XmlRpcValue& result) {
  bubblesim::refuse_unreadable(params);
  if (methodName == SYSTEM_MULTICALL) bubblesim::refuse_nested_multicall(params);
  return bubblesim::replaced_execute_method()(this, methodName, params, result);
}

bool ros::Header::parse(std::uint8_t* buffer, std::uint32_t size, std::string& error_msg) {
  if (bubblesim::lengths_fit(buffer, size)) return bubblesim::replaced_parse()(this, buffer, size, error_msg);
  error_msg = "Received an invalid TCPROS header. The length of a field exceeds the header's.";
  return false;
}
