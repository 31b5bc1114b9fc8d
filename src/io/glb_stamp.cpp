#include "io/glb_stamp.h"

#include <algorithm>
#include <optional>
#include <string_view>

#include "base/hash.h"
#include "io/glb_container.h"

namespace skinforge {

namespace {
constexpr std::size_t kDigits = 64;

// Offset of the stamp's digits in the file; none when there is no stamp.
std::optional<std::size_t> find_stamp(const Bytes& glb) {
  const std::string key = std::string("\"") + kStampKey + "\":\"";
  const auto json = parse_glb(glb).json;
  const std::string_view text(reinterpret_cast<const char*>(json.data()), json.size());
  const std::size_t at = text.find(key);
  if (at == std::string_view::npos) return std::nullopt;
  const std::size_t digits = at + key.size();
  if (digits + kDigits >= text.size() || text[digits + kDigits] != '"') return std::nullopt;
  return static_cast<std::size_t>(json.data() - glb.data()) + digits;
}

// Puts digits in the stamp's place.
void write(Bytes& glb, std::size_t at, const std::string& digits) {
  std::transform(digits.begin(), digits.end(), glb.begin() + static_cast<std::ptrdiff_t>(at),
                 [](char c) { return static_cast<std::byte>(c); });
}
}  // namespace

std::string unset_stamp() {
  return std::string(kDigits, '0');
}

Bytes stamped(Bytes glb) {
  const auto at = find_stamp(glb);
  if (!at) throw Error(ExitCode::Internal, "a GLB without a place for its digest");
  write(glb, *at, unset_stamp());
  const std::string digest = sha256(glb).hex();
  write(glb, *at, digest);
  return glb;
}

StampState check_stamp(const Bytes& glb) {
  const auto at = find_stamp(glb);
  if (!at) return StampState::Absent;
  return stamped(glb) == glb ? StampState::Right : StampState::Wrong;
}

}  // namespace skinforge
