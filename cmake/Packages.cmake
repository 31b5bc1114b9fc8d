# Every third-party package, found once. All come from Debian 12 (scripts/packages.txt).
list(APPEND CMAKE_MODULE_PATH "/usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB")
find_package(Threads REQUIRED)
find_package(Eigen3 CONFIG REQUIRED)
find_package(fmt CONFIG REQUIRED)
find_package(TBB CONFIG REQUIRED)  # before OpenVDB, or its own FindTBB is taken
find_package(OpenVDB REQUIRED COMPONENTS openvdb)
find_package(OpenMesh CONFIG REQUIRED)
find_package(assimp CONFIG REQUIRED)
find_package(PNG REQUIRED)
find_package(nlohmann_json CONFIG REQUIRED)
find_package(yaml-cpp CONFIG REQUIRED)
find_package(spdlog CONFIG REQUIRED)
find_package(CLI11 CONFIG REQUIRED)
set(OPENSSL_USE_STATIC_LIBS TRUE)  # a hash function, not 2 ms of loading the rest
find_package(OpenSSL REQUIRED COMPONENTS Crypto)
