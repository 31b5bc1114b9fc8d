#pragma once

#include <openssl/evp.h>

namespace skinforge {

/// OpenSSL's SHA-256, looked up once: `EVP_sha256()` is looked up anew in each digest, which takes longer than
/// hashing a kilobyte. For base/*.cpp only.
const EVP_MD* sha256_algorithm();

}  // namespace skinforge
