#pragma once

namespace skinforge {

/// Loads Assimp, which takes a quarter of the time in which the program starts and which only files other
/// than glTF need; further calls do nothing. Assimp's C functions that are used here are there without being
/// linked: each leads into the library and loads it when need be (assimp_library.cpp). Throws Error
/// (Internal) where the library or a function of it is missing.
void load_assimp();

}  // namespace skinforge
