// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <string_view>

#include "cbor/cbor_reader.hpp"

namespace bubblesim::bindings {
namespace {

using Kind = CborItem::Kind;

/// Bytes from hexadecimal digits; spaces are left out.
std::string hex(std::string_view digits) {
  std::string bytes;
  std::string pair;
  for (const char digit : digits) {
    if (digit == ' ') continue;
    pair += digit;
    if (pair.size() < 2) continue;
    bytes.push_back(static_cast<char>(std::stoi(pair, nullptr, 16)));
    pair.clear();
  }
  return bytes;
}

/// Why check_cbor refuses the data; empty if it does not.
std::string refusal(std::string_view data) {
  try {
    check_cbor(data);
  } catch (const CborError& error) {
    return error.what();
  }
  return {};
}

/// A head with an argument of four bytes.
std::string head(unsigned major, std::uint32_t argument) {
  std::string made(1, static_cast<char>(major << 5U | 26U));
  for (const unsigned shift : {24U, 16U, 8U, 0U}) made.push_back(static_cast<char>(argument >> shift));
  return made;
}

constexpr unsigned kMajorText = 3;
constexpr unsigned kList = 4;
constexpr unsigned kMajorMap = 5;

std::string repeated(const std::string& part, int count) {
  std::string all;
  for (int i = 0; i < count; ++i) all += part;
  return all;
}

/// A map whose keys are the numbers from 0 on, as integers or as strings of four bytes.
std::string map_of(std::uint32_t count, bool strings) {
  std::string made = head(kMajorMap, count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::string integer = head(0, i);
    made += (strings ? "\x64" + integer.substr(1) : integer) + '\x01';
  }
  return made;
}

/// A request of a client with values of all kinds, some of them in a list and a map that a break ends.
std::string request() {
  return hex(
      "a4 64 66756e63 6b 73696d2e736574506f7365"                        // func: sim.setPose
      "64 61726773 88 1820 9f fb3ff0000000000000 f93c00 fa3f800000 ff"  // args: 32, [1.0, 1.0, 1.0]
      "45 0102030405 390100 f5 f6 bf 6161 80 05 a0 ff 63 616263"        // bytes, -257, true, null, a map, abc
      "64 75756964 64 31323334 67 74696d656f7574 190258");              // uuid: 1234, timeout: 600
}

TEST(CborReader, ReadsOneItemAfterTheOther) {
  const std::string data = hex("85 18ff 3863 42 6162 fb3ff8000000000000 f5");
  CborReader reader(data);
  const CborItem list = reader.next();
  EXPECT_EQ(list.kind, Kind::kList);
  EXPECT_EQ(list.argument, 5U);
  const CborItem positive = reader.next();
  EXPECT_EQ(positive.kind, Kind::kUnsigned);
  EXPECT_EQ(positive.argument, 255U);
  const CborItem negative = reader.next();
  EXPECT_EQ(negative.kind, Kind::kNegative);
  EXPECT_EQ(negative.argument, 99U);  // -100
  const CborItem bytes = reader.next();
  EXPECT_EQ(bytes.kind, Kind::kBytes);
  EXPECT_EQ(bytes.bytes, "ab");
  const CborItem real = reader.next();
  EXPECT_EQ(real.kind, Kind::kReal);
  EXPECT_EQ(real.real, 1.5);
  EXPECT_FALSE(reader.at_end());
  EXPECT_EQ(reader.next().kind, Kind::kTrue);
  EXPECT_TRUE(reader.at_end());
  EXPECT_THROW(reader.next(), CborError);
}

TEST(CborReader, ReadsNumbersOfTwoFourAndEightBytes) {
  const auto real = [](std::string_view digits) { return CborReader(hex(digits)).next().real; };
  EXPECT_EQ(real("f93c00"), 1.0);
  EXPECT_EQ(real("f90001"), std::ldexp(1.0, -24));
  EXPECT_EQ(real("f9fc00"), -HUGE_VAL);
  EXPECT_TRUE(std::isnan(real("f97e00")));
  EXPECT_EQ(real("fa3fc00000"), 1.5);
  EXPECT_EQ(real("fbc010000000000000"), -4.0);
}

TEST(CborCheck, AcceptsARequestAndRefusesEachPartOfIt) {
  const std::string whole = request();
  EXPECT_EQ(refusal(whole), "");
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_EQ(refusal(whole.substr(0, size)), "the data ends early") << size;
  }
  EXPECT_EQ(refusal(whole + '\0'), "data follows the value");
}

TEST(CborCheck, RefusesWhatTheProtocolDoesNotHave) {
  EXPECT_EQ(refusal(hex("c0 63 616263")), "tagged values are not supported");
  EXPECT_EQ(refusal(hex("7f 61 61 ff")), "strings and bytes of unknown length are not supported");
  EXPECT_EQ(refusal(hex("1c")), "a length is malformed");
  EXPECT_EQ(refusal(hex("f0")), "a simple value is none of false, true and null");
  EXPECT_EQ(refusal(hex("a1 80 01")), "a list or a map is the key of a map");
  for (const char* digits : {"ff", "82 01 ff", "a1 ff 01", "a1 01 ff", "bf 01 ff"}) {
    EXPECT_EQ(refusal(hex(digits)), "a list or a map ends without having begun") << digits;
  }
}

TEST(CborCheck, RefusesLengthsThatTheDataDoNotHave) {
  for (const char* major : {"5b", "7b", "9b", "bb"}) {
    EXPECT_EQ(refusal(hex(major) + repeated("\xff", 8) + "abc"), "the data ends early") << major;
  }
}

TEST(CborCheck, LimitsLevels) {
  EXPECT_EQ(refusal(repeated("\x81", 32) + '\x01'), "");
  EXPECT_EQ(refusal(repeated("\x81", 33) + '\x01'), "more than 32 nested lists and maps");
  EXPECT_EQ(refusal(repeated("\x9f", 1'000'000)), "more than 32 nested lists and maps");
  EXPECT_EQ(refusal(repeated(hex("bf 61 61"), 100)), "more than 32 nested lists and maps");
}

TEST(CborCheck, LimitsTheItemsOfAMessage) {
  EXPECT_EQ(refusal(head(kList, 199'999) + repeated("\x01", 199'999)), "");
  EXPECT_NE(refusal(head(kList, 200'000) + repeated("\x01", 200'000)).find("more than 200,000 values"),
            std::string::npos);
  EXPECT_NE(refusal('\x9f' + repeated("\x80", 1'000'000)).find("more than 200,000 values"), std::string::npos);
}

TEST(CborCheck, LimitsTheEntriesOfAMap) {
  EXPECT_EQ(refusal(map_of(4096, true)), "");
  EXPECT_EQ(refusal(map_of(4097, true)), "more than 4,096 entries in a map");
}

// Integers can be chosen so that all collide in a dict of Python: 150,000 of them took half a minute.
TEST(CborCheck, LimitsTheKeysThatAreNoStrings) {
  EXPECT_EQ(refusal(map_of(1000, false)), "");
  EXPECT_EQ(refusal(map_of(1001, false)), "more than 1,000 keys of maps that are no strings");
  EXPECT_EQ(refusal(head(kList, 2) + repeated(map_of(501, false), 2)),
            "more than 1,000 keys of maps that are no strings");
}

TEST(CborCheck, LimitsTheStringsButNotTheBytes) {
  constexpr std::uint32_t kMost = 4 * 1024 * 1024;
  EXPECT_EQ(refusal(head(kMajorText, kMost) + std::string(kMost, 'a')), "");
  EXPECT_NE(refusal(head(kMajorText, kMost + 1) + std::string(kMost + 1, 'a')).find("more than 4 MiB of strings"),
            std::string::npos);
  EXPECT_EQ(refusal(head(2, 2 * kMost) + std::string(2 * kMost, 'a')), "");
}

// For the sanitizers: no changed message is read beyond its end.
TEST(CborCheck, AcceptsOrRefusesAMillionChangedRequests) {
  const std::string whole = request();
  std::minstd_rand random(1);
  int accepted = 0;
  for (int i = 0; i < 1'000'000; ++i) {
    std::string changed = whole;
    const auto changes = 1 + random() % 4;
    for (unsigned change = 0; change < changes; ++change) {
      changed[random() % changed.size()] = static_cast<char>(random() % 256);
    }
    if (random() % 4 == 0) changed.resize(random() % changed.size());
    changed.shrink_to_fit();
    accepted += refusal(changed).empty() ? 1 : 0;
  }
  EXPECT_GT(accepted, 10'000);
  EXPECT_LT(accepted, 990'000);
}

}  // namespace
}  // namespace bubblesim::bindings
