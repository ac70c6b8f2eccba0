// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include <mrpt/serialization/CArchive.h>
#include <mrpt/serialization/archiveFrom_std_streams.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "mrpt_sgraphs/io/atomic_file.h"
#include "mrpt_sgraphs/io/mrpt_network.h"

namespace mrpt_sgraphs {
namespace {

/// The bytes of a file to MRPT's deserialization, which believes every length that it reads and
/// allocates so much: a damaged file could ask for gigabytes. What MRPT reads in four bytes is a
/// length, a count or a version, and nothing has more parts than there are bytes left.
class BoundedArchive final : public mrpt::serialization::CArchive {
 public:
  explicit BoundedArchive(const std::string& bytes) : bytes_(bytes) {}

  std::size_t bytesLeft() const { return bytes_.size() - position_; }

 private:
  std::size_t read(void* destination, std::size_t count) override {
    if (count > bytesLeft()) {
      throw std::runtime_error("it ends after " + std::to_string(bytes_.size()) + " bytes");
    }
    std::memcpy(destination, bytes_.data() + position_, count);
    position_ += count;
    if (count == sizeof(std::uint32_t)) {
      std::uint32_t length = 0;
      std::memcpy(&length, destination, sizeof length);
      if (length > bytesLeft()) {
        throw std::runtime_error("it speaks of " + std::to_string(length) + " where only " +
                                 std::to_string(bytesLeft()) + " bytes are left");
      }
    }
    return count;
  }
  std::size_t write(const void*, std::size_t) override {
    throw std::logic_error("an archive to read from");
  }

  const std::string& bytes_;
  std::size_t position_ = 0;
};

std::string bytesOf(const std::string& path) {
  if (std::filesystem::is_directory(path)) {
    throw std::runtime_error("cannot read '" + path + "': it is a folder");
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw std::runtime_error("cannot read '" + path + "': " + std::strerror(errno));
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// MRPT's exceptions say `Message:  ...` on a line of its own, among a title and the call stack;
/// those of others pass through MRPT with the title and the stack alone around them.
std::string reasonOf(const std::exception& error) {
  std::istringstream lines(error.what());
  const std::string label = "Message:";
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line.front() == '=') continue;
    const std::size_t begin = line.compare(0, label.size(), label) == 0 ? label.size() : 0;
    const std::size_t text = line.find_first_not_of(' ', begin);
    if (text != std::string::npos) return line.substr(text);
  }
  return "it is damaged";
}

}  // namespace

MrptNetwork readMrptBinary(const std::string& path) {
  const std::string bytes = bytesOf(path);
  MrptNetwork network;
  std::string fault;
  try {
    BoundedArchive archive(bytes);
    archive >> network;
    fault = archive.bytesLeft() > 0 ? std::to_string(archive.bytesLeft()) + " bytes too many"
                                    : faultOf(network);
  } catch (const std::exception& error) {
    fault = reasonOf(error);
  }
  if (!fault.empty()) {
    throw std::runtime_error("'" + path +
                             "' is not a network of poses in MRPT's binary format: " + fault);
  }
  return network;
}

void writeMrptBinary(const std::string& path, const MrptNetwork& network) {
  const std::string fault = faultOf(network);
  if (!fault.empty()) throw std::invalid_argument(fault);
  if (network.edges_store_inverse_poses) {
    throw std::invalid_argument("the edges of the network store inverse poses");
  }
  AtomicFile file(path);
  auto archive = mrpt::serialization::archiveFrom<std::ostream>(file.stream());
  archive << network;
  file.commit();
}

}  // namespace mrpt_sgraphs
