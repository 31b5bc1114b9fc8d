# cmake -DMODULE=<library> -DHEADER=<file> -P write_module_id.cmake: name and SHA-256 of the library as C++.
file(SHA256 "${MODULE}" digest)
get_filename_component(name "${MODULE}" NAME)
file(WRITE "${HEADER}" "#pragma once
namespace skinforge {
inline constexpr const char* kVdbModule = \"${name}\";
inline constexpr const char* kVdbModuleSha256 = \"${digest}\";
}  // namespace skinforge
")
