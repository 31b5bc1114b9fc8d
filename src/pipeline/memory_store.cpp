#include <cerrno>

#include "pipeline/blob_store.h"

namespace skinforge {

std::optional<Bytes> MemoryStore::read(const std::string& path) const {
  const std::lock_guard lock(mutex_);
  const auto found = entries.find(path);
  return found == entries.end() ? std::nullopt : std::optional<Bytes>(found->second);
}

std::optional<std::uint64_t> MemoryStore::size(const std::string& path) const {
  const std::lock_guard lock(mutex_);
  const auto found = entries.find(path);
  return found == entries.end() ? std::nullopt : std::optional<std::uint64_t>(found->second.size());
}

std::optional<Digest> MemoryStore::digest(const std::string& path) const {
  const std::optional<Bytes> bytes = read(path);
  return bytes ? std::optional(sha256(*bytes)) : std::nullopt;
}

bool MemoryStore::write(const std::string& path, std::span<const std::byte> bytes) {
  const std::lock_guard lock(mutex_);
  if (is_read_only) {
    errno = EROFS;
    return false;
  }
  entries.insert_or_assign(path, Bytes(bytes.begin(), bytes.end()));
  return true;
}

void MemoryStore::remove(const std::string& path) {
  const std::lock_guard lock(mutex_);
  if (!is_read_only) entries.erase(path);
}

bool MemoryStore::is_there(const std::string& path) const {
  return size(path).has_value();
}

void MemoryStore::touch(const std::string& path) {
  const std::lock_guard lock(mutex_);
  ages.erase(path);
}

std::vector<BlobStore::Entry> MemoryStore::list(const std::string& folder) const {
  const std::lock_guard lock(mutex_);
  std::vector<Entry> found;
  for (const auto& [path, bytes] : entries)
    if (path.starts_with(folder + "/")) {
      const auto age = ages.find(path);
      found.push_back({path.substr(folder.size() + 1), bytes.size(), age == ages.end() ? 0 : age->second});
    }
  return found;
}

}  // namespace skinforge
