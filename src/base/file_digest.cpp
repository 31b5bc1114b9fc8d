#include "base/file_digest.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <chrono>
#include <fstream>
#include <sstream>

#include "base/sha256_algorithm.h"

namespace skinforge {

namespace {
constexpr std::size_t kHexDigits = 64;

std::int64_t nanoseconds(const timespec& time) {
  return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

std::int64_t now_ns() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

std::optional<FileStamp> stamp_in(const struct stat& status) {
  if (!S_ISREG(status.st_mode)) return std::nullopt;
  return FileStamp{status.st_dev, status.st_ino, static_cast<std::uint64_t>(status.st_size),
                   nanoseconds(status.st_mtim), nanoseconds(status.st_ctim)};
}

std::string digest_of_text(std::string_view text) {
  return sha256(std::as_bytes(std::span(text))).hex();
}
}  // namespace

std::optional<Digest> sha256_of_file(const std::filesystem::path& path) {
  Sha256 algorithm;
  std::ifstream file;
  std::array<char, 1 << 16> piece;
  file.rdbuf()->pubsetbuf(nullptr, 0);  // `piece` is the buffer
  file.open(path, std::ios::binary);
  if (!file) return std::nullopt;
  do {
    file.read(piece.data(), piece.size());
    algorithm.add(piece.data(), static_cast<std::size_t>(file.gcount()));
  } while (file);
  if (!file.eof()) return std::nullopt;
  return algorithm.finish();
}

std::optional<FileStamp> stamp_of(const std::filesystem::path& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 ? stamp_in(status) : std::nullopt;
}

std::optional<FileStamp> stamp_of(int descriptor) {
  struct stat status {};
  return ::fstat(descriptor, &status) == 0 ? stamp_in(status) : std::nullopt;
}

std::optional<Digest> FileDigests::of(const std::filesystem::path& path) {
  const auto before = stamp_of(path);
  if (!before) return std::nullopt;
  if (auto known = remembered(*before)) return known;
  const auto digest = sha256_of_file(path);
  if (digest && stamp_of(path) == before) remember(*before, *digest);
  return digest;
}

Digest FileDigests::of(std::span<const std::byte> bytes, const FileStamp& stamp) {
  if (auto known = remembered(stamp)) return *known;
  const Digest digest = sha256(bytes);
  remember(stamp, digest);
  return digest;
}

std::optional<Digest> FileDigests::remembered(const FileStamp& stamp) {
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find({stamp.device, stamp.inode});
  if (found == entries_.end() || found->second.stamp != stamp) return std::nullopt;
  found->second.is_used = true;
  return found->second.digest;
}

void FileDigests::remember(const FileStamp& stamp, const Digest& digest) {
  if (stamp.changed_ns + tick_ns_ >= now_ns()) return;
  const std::lock_guard lock(mutex_);
  entries_[{stamp.device, stamp.inode}] = {stamp, digest, true};
}

// "<sha256 of the rest>\n", then "<device> <inode> <size> <modified> <changed> <sha256>\n" for each file.
void FileDigests::recall(std::string text) {
  const std::lock_guard lock(mutex_);
  if (text.size() <= kHexDigits || digest_of_text(std::string_view(text).substr(kHexDigits + 1)) !=
                                       std::string_view(text).substr(0, kHexDigits))
    return;
  std::istringstream lines(text.substr(kHexDigits + 1));
  FileStamp stamp;
  for (std::string hex;
       lines >> stamp.device >> stamp.inode >> stamp.size >> stamp.modified_ns >> stamp.changed_ns >> hex;)
    if (const auto digest = digest_from_hex(hex)) entries_[{stamp.device, stamp.inode}] = {stamp, *digest};
  recalled_ = std::move(text);
}

std::string FileDigests::news() const {
  const std::lock_guard lock(mutex_);
  std::string rest;
  for (const auto& [where, entry] : entries_) {
    const FileStamp& stamp = entry.stamp;
    if (entry.is_used)
      rest += fmt::format("{} {} {} {} {} {}\n", stamp.device, stamp.inode, stamp.size, stamp.modified_ns,
                          stamp.changed_ns, entry.digest.hex());
  }
  if (rest.empty() && recalled_.empty()) return {};
  std::string text = digest_of_text(rest) + "\n" + rest;
  return text == recalled_ ? std::string() : text;
}

}  // namespace skinforge
