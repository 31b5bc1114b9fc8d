#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <random>

#include "pipeline/blob_store.h"

namespace skinforge {
namespace fs = std::filesystem;

namespace {
constexpr std::string_view kTemporaryPrefix = ".skinforge-";  // no other program's: they are removed

// A file descriptor that closes itself.
class File {
 public:
  File(const fs::path& path, int flags, mode_t mode = 0) : descriptor_(::open(path.c_str(), flags, mode)) {}
  ~File() {
    const int why = errno;  // of what failed before
    if (descriptor_ >= 0) ::close(descriptor_);
    errno = why;
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  bool is_open() const { return descriptor_ >= 0; }
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

// Size of a regular file; none for anything else, links included.
std::optional<std::uint64_t> regular_size(const fs::path& path) {
  struct stat status {};
  if (::lstat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
  return static_cast<std::uint64_t>(status.st_size);
}

bool read_all(int descriptor, std::span<std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t got = ::read(descriptor, bytes.data(), bytes.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(got));
  }
  return true;
}

bool write_all(int descriptor, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t put = ::write(descriptor, bytes.data(), bytes.size());
    if (put < 0 && errno == EINTR) continue;
    if (put == 0) errno = EIO;
    if (put <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(put));
  }
  return true;
}

std::string temporary_name() {
  thread_local std::random_device random;
  const auto digits = (static_cast<std::uint64_t>(random()) << 32) | random();
  return std::string(kTemporaryPrefix) + std::to_string(::getpid()) + "-" + std::to_string(digits);
}

// The prefix, the number of a process, "-" and a number.
bool is_temporary(std::string_view name) {
  if (!name.starts_with(kTemporaryPrefix)) return false;
  name.remove_prefix(kTemporaryPrefix.size());
  const std::size_t dash = std::min(name.find('-'), name.size());
  const auto is_number = [](std::string_view text) {
    return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
  };
  return is_number(name.substr(0, dash)) && is_number(name.substr(std::min(dash + 1, name.size())));
}

double age_seconds_of(const fs::path& path) {
  std::error_code error;
  const auto written = fs::last_write_time(path, error);
  if (error) return 0;
  return std::chrono::duration<double>(fs::file_time_type::clock::now() - written).count();
}

// Who writes a temporary holds a lock on it until it has its name, so a free one belongs to nobody: the
// kernel takes the locks of a killed process back. A process number would say less, being given out again,
// and anew in every container.
enum class Lock { Held, Taken, Unknown };

Lock try_lock(int descriptor) {
  int failed = 0;
  do failed = ::flock(descriptor, LOCK_EX | LOCK_NB);
  while (failed != 0 && errno == EINTR);
  if (failed == 0) return Lock::Held;
  return errno == EWOULDBLOCK ? Lock::Taken : Lock::Unknown;  // not every file system has locks
}

bool rename_file(const fs::path& from, const fs::path& to) {
  int failed = 0;
  do failed = ::rename(from.c_str(), to.c_str());
  while (failed != 0 && errno == EINTR);  // file systems in user space may be interrupted
  return failed == 0;
}

// A temporary that is open and locked. It goes with this object unless it got its name.
class Temporary {
 public:
  explicit Temporary(const fs::path& folder)
      : path_(folder / temporary_name()), file_(path_, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644) {
    is_ours_ = file_.is_open() && try_lock(file_.descriptor()) != Lock::Taken && is_named();
  }
  ~Temporary() {
    const int why = errno;
    if (file_.is_open() && !is_renamed_) ::unlink(path_.c_str());
    errno = why;
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  bool is_open() const { return file_.is_open(); }
  /// False when another process took it for left behind before it was locked.
  bool is_ours() const { return is_ours_; }
  int descriptor() const { return file_.descriptor(); }

  /// Some file systems tell of a failed write only on closing. The lock goes with the last descriptor.
  bool close_copy() const {
    const int copy = ::dup(file_.descriptor());
    return copy >= 0 && ::close(copy) == 0;
  }
  bool rename_to(const fs::path& path) { return is_renamed_ = rename_file(path_, path); }

 private:
  bool is_named() const {
    struct stat status {};
    return ::fstat(file_.descriptor(), &status) == 0 && status.st_nlink > 0;
  }

  fs::path path_;
  File file_;
  bool is_ours_ = false, is_renamed_ = false;
};

// Removes a temporary that nobody writes any more. Where locks are unknown, its age tells.
void remove_if_left_behind(const fs::path& path, double age_seconds) {
  const File file(path, O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK);
  if (!file.is_open()) return;
  const Lock lock = try_lock(file.descriptor());
  if (lock == Lock::Taken || (lock == Lock::Unknown && age_seconds_of(path) <= age_seconds)) return;
  ::unlink(path.c_str());
}

// Brings what was written to disk. Never tried again after a failure: the pages may be gone by then, and the
// second try would say that all is well.
bool sync(int descriptor) {
  return ::fsync(descriptor) == 0 || errno == EINVAL || errno == EROFS;  // no such thing on this file system
}

// Temporary in the same folder, `finish(descriptor)`, rename.
template <class Finish>
bool replace_file(const fs::path& path, std::span<const std::byte> bytes, Finish finish) {
  constexpr int kTries = 20;  // ours: a sweep that meets each one just before its lock is no sweep
  for (int tries = 0; tries < kTries; ++tries) {
    Temporary temporary(path.parent_path());
    if (!temporary.is_open()) return false;
    errno = EBUSY;
    if (!temporary.is_ours()) continue;
    if (write_all(temporary.descriptor(), bytes) && finish(temporary.descriptor()) &&
        temporary.close_copy() && temporary.rename_to(path))
      return true;
    if (errno != ENOENT) return false;  // else taken away by a machine that does not see the lock
  }
  return false;
}
}  // namespace

bool write_file_atomically(const fs::path& path, std::span<const std::byte> bytes) {
  return replace_file(path, bytes, [](int) { return true; });
}

bool write_file_durably(const fs::path& path, std::span<const std::byte> bytes) {
  return replace_file(path, bytes, sync);
}

bool sync_folder(const fs::path& folder) {
  const File file(folder.empty() ? fs::path(".") : folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  return file.is_open() && sync(file.descriptor());
}

std::optional<Bytes> DiskStore::read(const std::string& path) const {
  const File file(root_ / path, O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK);
  struct stat status {};
  if (!file.is_open() || ::fstat(file.descriptor(), &status) != 0 || !S_ISREG(status.st_mode))
    return std::nullopt;
  Bytes bytes(static_cast<std::size_t>(status.st_size));
  if (!read_all(file.descriptor(), bytes)) return std::nullopt;
  return bytes;
}

std::optional<std::uint64_t> DiskStore::size(const std::string& path) const {
  return regular_size(root_ / path);
}

std::optional<Digest> DiskStore::digest(const std::string& path) const {
  if (!size(path)) return std::nullopt;
  return digests_ ? digests_->of(root_ / path) : sha256_of_file(root_ / path);
}

bool DiskStore::write(const std::string& path, std::span<const std::byte> bytes) {
  const fs::path target = root_ / path;
  std::error_code error;
  fs::create_directories(target.parent_path(), error);
  if (error) errno = error.value();
  if (error) return false;
  tidy_once(fs::path(path).parent_path());
  if (fs::is_directory(fs::symlink_status(target, error))) fs::remove_all(target, error);  // rename cannot
  return write_file_atomically(target, bytes);
}

void DiskStore::tidy_once(const std::string& folder) {
  {
    const std::lock_guard lock(mutex_);
    if (!tidied_.insert(folder).second) return;
  }
  remove_stale_temporaries(folder);
}

void DiskStore::remove(const std::string& path) {
  std::error_code error;
  fs::remove_all(root_ / path, error);
}

bool DiskStore::is_there(const std::string& path) const {
  struct stat status {};
  return ::lstat((root_ / path).c_str(), &status) == 0;
}

void DiskStore::touch(const std::string& path) {
  ::utimensat(AT_FDCWD, (root_ / path).c_str(), nullptr, AT_SYMLINK_NOFOLLOW);
}

std::vector<BlobStore::Entry> DiskStore::list(const std::string& folder) const {
  std::vector<Entry> found;
  std::error_code error;
  for (fs::directory_iterator item(root_ / folder, error), end; !error && item != end;
       item.increment(error)) {
    const std::string name = item->path().filename();
    if (!is_temporary(name))
      found.push_back({name, regular_size(item->path()).value_or(0), age_seconds_of(item->path())});
  }
  std::sort(found.begin(), found.end(), [](const Entry& a, const Entry& b) { return a.name < b.name; });
  return found;
}

void DiskStore::remove_stale_temporaries(const std::string& folder, double age_seconds) const {
  std::error_code error;
  std::vector<fs::path> found;
  for (fs::directory_iterator item(root_ / folder, error), end; !error && item != end; item.increment(error))
    if (is_temporary(item->path().filename().string())) found.push_back(item->path());
  for (const fs::path& path : found) remove_if_left_behind(path, age_seconds);
}

}  // namespace skinforge
