// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <functional>
#include <limits>
#include <random>

#include "mrpt_sgraphs/frontend/prefilter.h"
#include "raw_cloud_builder.h"

namespace mrpt_sgraphs {
namespace {

using test::OwnedRawCloud;
using test::plainSweep;
using test::RawCloudBuilder;
using Type = RawCloud::Type;

/// A sound cloud: x, y, z at 0, 4, 8 and the time at 12; 20 x 50 points of 16 bytes.
OwnedRawCloud soundCloud() {
  RawCloudBuilder builder = plainSweep();
  builder.width = 50;
  builder.height = 20;
  builder.field("t", Type::kUint32, [](std::size_t i) { return 1e5 * double(i); });
  return builder.build();
}

struct Fault {
  const char* name;
  std::function<void(RawCloud*)> make;
  std::vector<const char*> words;  ///< That the problem has to name.
};

std::ostream& operator<<(std::ostream& out, const Fault& fault) { return out << fault.name; }

class PrefilterFault : public ::testing::TestWithParam<Fault> {};

TEST_P(PrefilterFault, IsNamedWithItsNumbers) {
  const OwnedRawCloud sound = soundCloud();
  RawCloud raw = sound.view();
  ASSERT_EQ(Prefilter({}).filter(raw, Pose::Identity(), "base_link").problem, "");
  GetParam().make(&raw);
  const PrefilterResult result = Prefilter({}).filter(raw, Pose::Identity(), "base_link");
  EXPECT_EQ(result.cloud, nullptr);
  for (const char* word : GetParam().words) {
    EXPECT_NE(result.problem.find(word), std::string::npos) << word << ": " << result.problem;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Faults, PrefilterFault,
    ::testing::Values(
        Fault{"NoRows", [](RawCloud* raw) { raw->height = 0; }, {"empty", "width 50", "height 0"}},
        Fault{"NoColumns", [](RawCloud* raw) { raw->width = 0; }, {"empty", "width 0"}},
        Fault{"NoX", [](RawCloud* raw) { raw->fields[0].name = "X"; }, {"'x'", "X y z t"}},
        Fault{"NoY", [](RawCloud* raw) { raw->fields.erase(raw->fields.begin() + 1); }, {"'y'"}},
        Fault{"NoFields", [](RawCloud* raw) { raw->fields.clear(); }, {"'x'", "none"}},
        Fault{"IntegerZ", [](RawCloud* raw) { raw->fields[2].type = Type::kInt32; },
              {"'z'", "type 5", "FLOAT32"}},
        Fault{"TypeThatIsNone",
              [](RawCloud* raw) { raw->fields[1].type = static_cast<Type>(200); },
              {"'y'", "200"}},
        Fault{"DataTooShort", [](RawCloud* raw) { raw->size -= 1; }, {"15999", "50 x 20", "16"}},
        Fault{"NoData", [](RawCloud* raw) { raw->size = 0; }, {"0 bytes", "50 x 20"}},
        Fault{"RowsOverlap", [](RawCloud* raw) { raw->row_step = 16; }, {"16000 bytes", "50 x 20"}},
        Fault{"RowsTooFarApart", [](RawCloud* raw) { raw->row_step = 900; }, {"50 x 20"}},
        Fault{"MorePointsThanFit", [](RawCloud* raw) { raw->width = raw->height = 4294967295U; },
              {"4294967295"}},
        Fault{"FieldOutsideThePoint", [](RawCloud* raw) { raw->fields[3].offset = 13; },
              {"'t'", "byte 13", "16 bytes"}},
        Fault{"OffsetOverflows", [](RawCloud* raw) { raw->fields[0].offset = 4294967294U; },
              {"'x'", "4294967294"}},
        Fault{"PointsOfNoBytes", [](RawCloud* raw) { raw->point_step = 0; }, {"'x'", "0 bytes"}},
        Fault{"BigEndian", [](RawCloud* raw) { raw->is_bigendian = true; }, {"big-endian"}},
        Fault{"StampNotANumber",
              [](RawCloud* raw) { raw->stamp_s = std::numeric_limits<double>::quiet_NaN(); },
              {"stamp"}},
        Fault{"StampInfinite",
              [](RawCloud* raw) { raw->stamp_s = std::numeric_limits<double>::infinity(); },
              {"stamp"}},
        Fault{"TooFewPoints", [](RawCloud* raw) { raw->height = 1, raw->width = 49; },
              {"49 of 49"}}),
    [](const auto& info) { return std::string(info.param.name); });

TEST(PrefilterFaults, TooFewPointsAreCounted) {
  PrefilterConfig config;
  config.max_range_m = 4.0;  // all are at 5 m
  const PrefilterResult result =
      Prefilter(config).filter(soundCloud().view(), Pose::Identity(), "base_link");
  EXPECT_EQ(result.problem.rfind("only 0 of 1000 points", 0), 0U) << result.problem;
  EXPECT_NE(result.problem.find("1000 out of range"), std::string::npos) << result.problem;
}

/// Bytes that end where the process may read no further.
class GuardedBytes {
 public:
  explicit GuardedBytes(const std::vector<std::uint8_t>& bytes) {
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    const std::size_t readable = (bytes.size() + page - 1) / page * page;
    length_ = readable + page;
    pages_ = mmap(nullptr, length_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (pages_ == MAP_FAILED) throw std::runtime_error("no memory");
    auto* const first = static_cast<std::uint8_t*>(pages_);
    end_ = first + readable;
    std::copy(bytes.begin(), bytes.end(), end_ - bytes.size());
    mprotect(end_, page, PROT_NONE);
  }
  ~GuardedBytes() { munmap(pages_, length_); }
  GuardedBytes(const GuardedBytes&) = delete;
  GuardedBytes& operator=(const GuardedBytes&) = delete;

  /// The last `size` bytes.
  const std::uint8_t* last(std::size_t size) const { return end_ - size; }

 private:
  void* pages_ = nullptr;
  std::size_t length_ = 0;
  std::uint8_t* end_ = nullptr;
};

/// Headers that are wrong at random, mostly a little.
class Mutator {
 public:
  void mutate(RawCloud* raw) {
    for (std::uint32_t count = 1 + number(2); count > 0; --count) mutateOnce(raw);
  }

 private:
  std::uint32_t number(std::uint32_t below) {
    return std::uniform_int_distribution<std::uint32_t>(0, below - 1)(generator_);
  }

  std::uint32_t size(std::uint32_t usual) {
    static constexpr std::uint32_t kExtremes[] = {0, 1, 65536, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF};
    switch (number(4)) {
      case 0:
        return kExtremes[number(6)];
      case 1:
        return usual + number(3) - 1;
      default:
        return number(usual + 1);
    }
  }

  void mutateOnce(RawCloud* raw) {
    const std::uint32_t count = static_cast<std::uint32_t>(raw->fields.size());
    RawCloud::Field* const field = count > 0 ? &raw->fields[number(count)] : nullptr;
    switch (number(9)) {
      case 0:
        raw->width = size(raw->width);
        break;
      case 1:
        raw->height = size(raw->height);
        break;
      case 2:
        raw->point_step = size(raw->point_step);
        break;
      case 3:
        raw->row_step = size(raw->row_step);
        break;
      case 4:
        raw->size = number(static_cast<std::uint32_t>(raw->size) + 1);
        break;
      case 5:
        if (field != nullptr) field->offset = size(raw->point_step);
        break;
      case 6:
        if (field != nullptr) field->type = static_cast<Type>(number(256) < 192 ? number(10) : 255);
        break;
      case 7: {
        static const char* const kNames[] = {"x", "y", "z", "time", "t", "ring", "intensity", ""};
        if (field != nullptr) field->name = kNames[number(8)];
        break;
      }
      default:
        if (field != nullptr) field->count = size(1);
        if (number(8) == 0) raw->is_bigendian = true;
    }
  }

  std::mt19937 generator_{42};
};

TEST(PrefilterFaults, HeadersThatLieDoNoHarm) {
  RawCloudBuilder builder = plainSweep();
  builder.width = 25;
  builder.height = 8;
  builder.field("ring", Type::kUint16, [](std::size_t i) { return double(i % 16); });
  builder.field("t", Type::kUint32, [](std::size_t i) { return 1e5 * double(i); });
  const OwnedRawCloud sound = builder.build();
  const GuardedBytes guarded(sound.bytes);

  Mutator mutator;
  int refused = 0;
  constexpr int kTrials = 2000;
  for (int trial = 0; trial < kTrials; ++trial) {
    SCOPED_TRACE(trial);
    RawCloud raw = sound.view();
    mutator.mutate(&raw);
    raw.data = guarded.last(raw.size);
    const PrefilterResult result = Prefilter({}).filter(raw, Pose::Identity(), "base_link");
    ASSERT_EQ(result.cloud == nullptr, !result.problem.empty());
    if (result.cloud == nullptr) {
      ++refused;
      continue;
    }
    ASSERT_EQ(result.received, std::size_t{raw.width} * raw.height);
    ASSERT_EQ(result.received, result.invalid + result.outside + result.cloud->size());
    for (const Point& point : *result.cloud) {
      ASSERT_TRUE(point.getVector3fMap().allFinite());
      ASSERT_LE(std::abs(point.time), 2.001F);
    }
  }
  // the mutations are neither all deadly nor all harmless
  EXPECT_GT(refused, kTrials / 4);
  EXPECT_LT(refused, 3 * kTrials / 4);
}

}  // namespace
}  // namespace mrpt_sgraphs
