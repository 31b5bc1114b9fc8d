#pragma once

#define OPENSSL_SUPPRESS_DEPRECATED  // the new interface loads providers and their settings: 2 ms of every
                                     // start
#include <openssl/sha.h>

#include <cstddef>

#include "base/hash.h"

namespace skinforge {

/// SHA-256 piece by piece. For base/*.cpp only.
class Sha256 {
 public:
  Sha256() { SHA256_Init(&state_); }
  void add(const void* bytes, std::size_t size) { SHA256_Update(&state_, bytes, size); }
  /// Once.
  Digest finish() {
    Digest digest;
    SHA256_Final(digest.bytes.data(), &state_);
    return digest;
  }

 private:
  SHA256_CTX state_;
};

}  // namespace skinforge
