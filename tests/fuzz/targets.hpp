// SPDX-License-Identifier: BSD-3-Clause
// The readers of bytes from outside: files, messages, requests. Each takes any bytes and either reads them or
// throws its documented errors, which are caught here. Whatever else leaves, or stops the program, is a defect.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace bubblesim::fuzz {

/// Thrown when a reader breaks a promise beyond "no crash", such as "what is refused changes nothing".
struct BrokenPromise {
  const char* promise;
};

inline void require(bool holds, const char* promise) {
  if (!holds) throw BrokenPromise{promise};
}

void read_cbor(std::string_view data);      ///< a request of a remote client
void read_material(std::string_view data);  ///< an OGRE material script
void read_mesh(std::string_view data);      ///< the arrays of a mesh, see mesh.cpp
void read_message(std::string_view data);   ///< two bytes that choose a type, then a message in its layout
void read_picture(std::string_view data);   ///< the pixels of an image, see picture.cpp
void read_scene(std::string_view data);     ///< SDFormat or URDF
void read_snapshot(std::string_view data);  ///< changes of a saved state, see snapshot.cpp
void read_ttt(std::string_view data);       ///< a file of CoppeliaSim

struct Target {
  std::string name;
  void (*read)(std::string_view data);
};

/// All of the above; a target's seeds and findings are in tests/corpus/NAME.
const std::vector<Target>& targets();

}  // namespace bubblesim::fuzz
