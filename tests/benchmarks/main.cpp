// The benchmarks are their own import worker: the sandbox starts the running program again.
#include <benchmark/benchmark.h>

#include <string_view>

#include "io/sandbox.h"

int main(int argc, char** argv) {
  if (argc > 1 && std::string_view(argv[1]) == "--import-worker")
    return skinforge::import_worker_main(argc, argv);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
