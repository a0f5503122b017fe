// SPDX-License-Identifier: BSD-3-Clause
// Each reader takes the seeds and former findings of its fuzzer without a defect.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "targets.hpp"

namespace bubblesim::fuzz {
namespace {

namespace fs = std::filesystem;

class Corpus : public testing::TestWithParam<Target> {};

std::string bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST_P(Corpus, IsReadWithoutDefect) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(BUBBLESIM_CORPUS) / GetParam().name)) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  EXPECT_FALSE(files.empty());
  for (const fs::path& file : files) {
    SCOPED_TRACE(file.filename().string());
    try {
      GetParam().read(bytes_of(file));
    } catch (const BrokenPromise& broken) {
      ADD_FAILURE() << "broken: " << broken.promise;
    } catch (const std::exception& error) {
      ADD_FAILURE() << "an undocumented error: " << error.what();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, Corpus, testing::ValuesIn(targets()),
                         [](const testing::TestParamInfo<Target>& info) { return info.param.name; });

}  // namespace
}  // namespace bubblesim::fuzz
