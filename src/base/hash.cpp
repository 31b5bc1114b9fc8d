#include "base/hash.h"

#include "base/sha256_algorithm.h"
#include "base/text.h"

namespace skinforge {

std::string Digest::hex() const {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string text(2 * bytes.size(), '0');
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    text[2 * i] = kDigits[bytes[i] >> 4];
    text[2 * i + 1] = kDigits[bytes[i] & 15];
  }
  return text;
}

namespace {
int hex_value(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return -1;
}
}  // namespace

std::optional<Digest> digest_from_hex(std::string_view hex) {
  Digest digest;
  if (hex.size() != 2 * digest.bytes.size()) return std::nullopt;
  for (std::size_t i = 0; i < digest.bytes.size(); ++i) {
    const int high = hex_value(hex[2 * i]), low = hex_value(hex[2 * i + 1]);
    if (high < 0 || low < 0) return std::nullopt;
    digest.bytes[i] = static_cast<std::uint8_t>(high * 16 + low);
  }
  return digest;
}

Digest sha256(std::span<const std::byte> bytes) {
  Sha256 algorithm;
  algorithm.add(bytes.data(), bytes.size());
  return algorithm.finish();
}

struct Hasher::State {
  Sha256 algorithm;
  std::vector<HashedField>* log = nullptr;

  void update(std::span<const std::byte> bytes) {
    const auto size = static_cast<std::uint64_t>(bytes.size());
    algorithm.add(&size, sizeof size);
    algorithm.add(bytes.data(), bytes.size());
  }
};

Hasher::Hasher() : state_(std::make_unique<State>()) {}
Hasher::~Hasher() = default;
Hasher::Hasher(Hasher&&) noexcept = default;
Hasher& Hasher::operator=(Hasher&&) noexcept = default;

void Hasher::add_bytes(std::string_view name, std::span<const std::byte> value, std::string readable) {
  state_->update(std::as_bytes(std::span(name)));
  state_->update(value);
  if (state_->log) state_->log->push_back({std::string(name), std::move(readable)});
}

std::string Hasher::list_text(std::span<const std::string> words) {
  std::string text = "[";
  for (const std::string& word : words) text += (text.size() > 1 ? ", " : "") + printable(word);
  return text + "]";
}

void Hasher::add(std::string_view name, std::span<const std::byte> value) {
  add_bytes(name, value, state_->log ? "sha256:" + sha256(value).hex().substr(0, 12) : std::string());
}

void Hasher::add(std::string_view name, std::string_view value) {
  add_bytes(name, std::as_bytes(std::span(value)), state_->log ? printable(value) : std::string());
}

void Hasher::add(std::string_view name, const Digest& value) {
  add(name, std::span<const std::byte>(std::as_bytes(std::span(value.bytes))));
}

void Hasher::log_to(std::vector<HashedField>& log) {
  state_->log = &log;
}

Digest Hasher::finish() {
  return state_->algorithm.finish();
}

}  // namespace skinforge
