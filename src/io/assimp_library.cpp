#include "io/assimp_library.h"

#include <assimp/cimport.h>
#include <assimp/material.h>
#include <dlfcn.h>

#include <string>

#include "base/error.h"

namespace skinforge {
namespace {

[[noreturn]] void fail() {
  const char* reason = ::dlerror();
  throw Error(ExitCode::Internal,
              std::string(SKINFORGE_ASSIMP_LIBRARY) + ": " + (reason ? reason : "broken"));
}

void* library() {
  static void* const loaded = ::dlopen(SKINFORGE_ASSIMP_LIBRARY, RTLD_LAZY | RTLD_LOCAL);
  if (!loaded) fail();
  return loaded;
}

// The library's function of that name, of the type of our own.
template <class Function>
Function* in_library(Function*, const char* name) {
  void* const found = ::dlsym(library(), name);
  if (!found) fail();
  return reinterpret_cast<Function*>(found);
}

}  // namespace

void load_assimp() {
  library();
}

}  // namespace skinforge

using skinforge::in_library;

extern "C" {

const aiScene* aiImportFileExWithProperties(const char* file, unsigned int flags, aiFileIO* files,
                                            const aiPropertyStore* properties) {
  static const auto call = in_library(&aiImportFileExWithProperties, "aiImportFileExWithProperties");
  return call(file, flags, files, properties);
}

void aiReleaseImport(const aiScene* scene) {
  static const auto call = in_library(&aiReleaseImport, "aiReleaseImport");
  call(scene);
}

const char* aiGetErrorString(void) {
  static const auto call = in_library(&aiGetErrorString, "aiGetErrorString");
  return call();
}

aiBool aiIsExtensionSupported(const char* extension) {
  static const auto call = in_library(&aiIsExtensionSupported, "aiIsExtensionSupported");
  return call(extension);
}

aiPropertyStore* aiCreatePropertyStore(void) {
  static const auto call = in_library(&aiCreatePropertyStore, "aiCreatePropertyStore");
  return call();
}

void aiReleasePropertyStore(aiPropertyStore* store) {
  static const auto call = in_library(&aiReleasePropertyStore, "aiReleasePropertyStore");
  call(store);
}

void aiSetImportPropertyInteger(aiPropertyStore* store, const char* name, int value) {
  static const auto call = in_library(&aiSetImportPropertyInteger, "aiSetImportPropertyInteger");
  call(store, name, value);
}

aiReturn aiGetMaterialColor(const aiMaterial* material, const char* key, unsigned int type,
                            unsigned int index, aiColor4D* color) {
  static const auto call = in_library(&aiGetMaterialColor, "aiGetMaterialColor");
  return call(material, key, type, index, color);
}

aiReturn aiGetMaterialFloatArray(const aiMaterial* material, const char* key, unsigned int type,
                                 unsigned int index, ai_real* values, unsigned int* count) {
  static const auto call = in_library(&aiGetMaterialFloatArray, "aiGetMaterialFloatArray");
  return call(material, key, type, index, values, count);
}

aiReturn aiGetMaterialIntegerArray(const aiMaterial* material, const char* key, unsigned int type,
                                   unsigned int index, int* values, unsigned int* count) {
  static const auto call = in_library(&aiGetMaterialIntegerArray, "aiGetMaterialIntegerArray");
  return call(material, key, type, index, values, count);
}

aiReturn aiGetMaterialString(const aiMaterial* material, const char* key, unsigned int type,
                             unsigned int index, aiString* text) {
  static const auto call = in_library(&aiGetMaterialString, "aiGetMaterialString");
  return call(material, key, type, index, text);
}

unsigned int aiGetMaterialTextureCount(const aiMaterial* material, aiTextureType type) {
  static const auto call = in_library(&aiGetMaterialTextureCount, "aiGetMaterialTextureCount");
  return call(material, type);
}

aiReturn aiGetMaterialTexture(const aiMaterial* material, aiTextureType type, unsigned int index,
                              aiString* path, aiTextureMapping* mapping, unsigned int* uv_set, ai_real* blend,
                              aiTextureOp* operation, aiTextureMapMode* modes, unsigned int* flags) {
  static const auto call = in_library(&aiGetMaterialTexture, "aiGetMaterialTexture");
  return call(material, type, index, path, mapping, uv_set, blend, operation, modes, flags);
}

}  // extern "C"
