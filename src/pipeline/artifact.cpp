#include "pipeline/artifact.h"

#include "base/expect.h"

namespace skinforge {

Artifact::Artifact(Digest digest, std::uint64_t size, Loader loader)
    : digest_(digest), size_(size), loader_(std::move(loader)) {}

void Artifact::expect_type(std::type_index type) const {
  SF_EXPECT(type_ && *type_ == type);  // one artifact is read as one type only
}

std::optional<Bytes> Artifact::bytes() const {
  const std::lock_guard lock(mutex_);
  if (bytes_) return bytes_;
  if (type_ && *type_ == typeid(Bytes)) return *static_cast<const Bytes*>(value_.get());
  return loader_ ? loader_() : std::nullopt;
}

bool Artifact::try_load() const {
  const std::lock_guard lock(mutex_);
  if (bytes_ || value_) return true;
  if (loader_) bytes_ = loader_();
  return bytes_.has_value();
}

void Artifact::stored(Loader loader) {
  const std::lock_guard lock(mutex_);
  loader_ = std::move(loader);
  if (value_) bytes_.reset();
}

void Artifact::restore(Bytes bytes) {
  SF_EXPECT(sha256(bytes) == digest_);
  const std::lock_guard lock(mutex_);
  bytes_ = std::move(bytes);
}

}  // namespace skinforge
