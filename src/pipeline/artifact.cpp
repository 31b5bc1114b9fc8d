#include "pipeline/artifact.h"

#include "base/expect.h"

namespace skinforge {

Artifact::Artifact(Digest digest, std::uint64_t size, Loader loader)
    : digest_(digest), size_(size), loader_(std::move(loader)) {}

void Artifact::expect_type(std::type_index type) const {
  SF_EXPECT(type_ && *type_ == type);  // one artifact is read as one type only
}

std::shared_ptr<const Bytes> Artifact::load() const {
  std::optional<Bytes> bytes = loader_ ? loader_() : std::nullopt;
  return bytes ? std::make_shared<const Bytes>(*std::move(bytes)) : nullptr;
}

std::shared_ptr<const Bytes> Artifact::bytes() const {
  const std::lock_guard lock(mutex_);
  if (bytes_) return bytes_;
  if (value_ && *type_ == typeid(Bytes)) return std::static_pointer_cast<const Bytes>(value_);
  auto bytes = load();
  if (!bytes && value_) bytes = std::make_shared<const Bytes>(encode_(value_.get()));
  return bytes;
}

bool Artifact::try_load() const {
  const std::lock_guard lock(mutex_);
  if (bytes_ || value_) return true;
  bytes_ = load();
  return bytes_ != nullptr;
}

void Artifact::stored(Loader loader) {
  const std::lock_guard lock(mutex_);
  loader_ = std::move(loader);
  if (value_) bytes_.reset();
}

void Artifact::restore(Bytes bytes) {
  SF_EXPECT(sha256(bytes) == digest_);
  const std::lock_guard lock(mutex_);
  bytes_ = std::make_shared<const Bytes>(std::move(bytes));
}

}  // namespace skinforge
