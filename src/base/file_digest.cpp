#include "base/file_digest.h"

#include <openssl/evp.h>

#include <fstream>

#include "base/expect.h"

namespace skinforge {

std::optional<Digest> sha256_of_file(const std::filesystem::path& path) {
  const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context(EVP_MD_CTX_new(), &EVP_MD_CTX_free);
  SF_EXPECT(context && EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr) == 1);
  std::ifstream file;
  std::array<char, 1 << 16> piece;
  file.rdbuf()->pubsetbuf(nullptr, 0);  // `piece` is the buffer
  file.open(path, std::ios::binary);
  if (!file) return std::nullopt;
  do {
    file.read(piece.data(), piece.size());
    EVP_DigestUpdate(context.get(), piece.data(), static_cast<std::size_t>(file.gcount()));
  } while (file);
  if (!file.eof()) return std::nullopt;
  Digest digest;
  SF_EXPECT(EVP_DigestFinal_ex(context.get(), digest.bytes.data(), nullptr) == 1);
  return digest;
}

}  // namespace skinforge
