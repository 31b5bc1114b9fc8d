// The tests of this layer are their own import worker: the sandbox starts the running program again.
#include <gmock/gmock.h>

#include <string_view>

#include "io/sandbox.h"

int main(int argc, char** argv) {
  if (argc > 1 && std::string_view(argv[1]) == "--import-worker")
    return skinforge::import_worker_main(argc, argv);
  testing::InitGoogleMock(&argc, argv);
  return RUN_ALL_TESTS();
}
