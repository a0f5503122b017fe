// SPDX-License-Identifier: BSD-3-Clause
// Once a simulation runs, its steps allocate no memory of our own code. A program of its own, because it replaces
// operator new.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdlib>
#include <new>
#include <string>

#include "bubblesim/scene_loader.hpp"
#include "bubblesim/simulation.hpp"

namespace {

thread_local bool counts = false;
thread_local long allocations = 0;

void* allocate(std::size_t size) {
  if (counts) ++allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) { return allocate(size); }
void* operator new[](std::size_t size) { return allocate(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace bubblesim::test::test_allocations {
namespace {

class Steps : public testing::TestWithParam<std::string> {};

TEST_P(Steps, AllocateNothing) {
  Simulation simulation(load_scene(GetParam()));
  for (int i = 0; i < 200; ++i) simulation.step();
  allocations = 0;
  counts = true;
  for (int i = 0; i < 200; ++i) simulation.step();
  counts = false;
  EXPECT_EQ(allocations, 0);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Steps, testing::Values("ball", "bubblerob", "pioneer", "quadcopter", "tricycle"),
                         [](const testing::TestParamInfo<std::string>& info) { return info.param; });

}  // namespace
}  // namespace bubblesim::test::test_allocations
