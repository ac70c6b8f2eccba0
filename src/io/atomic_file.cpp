// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/io/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <locale>
#include <stdexcept>
#include <utility>

namespace mrpt_sgraphs {
namespace {

[[noreturn]] void throwErrno(const std::string& path, int error) {
  const std::string reason = error != 0 ? std::strerror(error) : "the stream failed";
  throw std::runtime_error("cannot write '" + path + "': " + reason);
}

/// Beside `path`, so that the rename stays on one file system; of this process and this object
/// alone.
std::string temporaryPathFor(const std::string& path) {
  static std::atomic<unsigned> counter{0};
  return path + "." + std::to_string(getpid()) + "-" + std::to_string(counter++) + ".tmp";
}

/// Brings what was written to the disk.
void syncToDisk(const std::string& written_path, const std::string& reported_path) {
  const int descriptor = open(written_path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) throwErrno(reported_path, errno);
  const int error = fsync(descriptor) == 0 ? 0 : errno;
  close(descriptor);
  // Some file systems (pipes, a few network mounts) cannot sync; the data is then as safe as it
  // gets.
  if (error != 0 && error != EINVAL && error != ENOTSUP) throwErrno(reported_path, error);
}

}  // namespace

AtomicFile::AtomicFile(std::string path)
    : path_(std::move(path)), temporary_path_(temporaryPathFor(path_)) {
  if (std::filesystem::is_directory(path_)) throwErrno(path_, EISDIR);
  errno = 0;
  stream_.open(temporary_path_, std::ios::binary | std::ios::trunc);
  if (!stream_) throwErrno(path_, errno);
  stream_.imbue(std::locale::classic());
}

AtomicFile::~AtomicFile() {
  if (temporary_path_.empty()) return;
  stream_.close();
  std::remove(temporary_path_.c_str());
}

void AtomicFile::commit() {
  if (temporary_path_.empty()) throw std::logic_error("'" + path_ + "' was committed before");
  if (!stream_) throwErrno(path_, errno);  // the last thing that failed here, most often the write
  errno = 0;
  stream_.close();
  if (!stream_) throwErrno(path_, errno);

  syncToDisk(temporary_path_, path_);
  if (std::rename(temporary_path_.c_str(), path_.c_str()) != 0) throwErrno(path_, errno);
  temporary_path_.clear();
}

}  // namespace mrpt_sgraphs
