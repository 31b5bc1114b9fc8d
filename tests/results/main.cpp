// These tests import FBX files, so they are their own import worker.
#include <gmock/gmock.h>

#include <string_view>

#include "io/sandbox.h"

int main(int argc, char** argv) {
  if (argc > 1 && std::string_view(argv[1]) == "--import-worker")
    return skinforge::import_worker_main(argc, argv);
  testing::InitGoogleMock(&argc, argv);
  return RUN_ALL_TESTS();
}
