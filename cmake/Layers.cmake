# A repeated compile costs nothing where ccache is installed.
find_program(CCACHE ccache)
if(CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CCACHE}")
endif()

# Flags shared by all our targets, and the two functions that declare a layer and its tests.
add_library(skinforge_warnings INTERFACE)
target_compile_features(skinforge_warnings INTERFACE cxx_std_20)
target_compile_options(skinforge_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Werror
  $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>  # gcc 12 sees it in Eigen's fixed-size products where there is none
  -ffp-contract=off)  # the same bits with and without fused multiply-add

# skinforge_layer(<name> [LAYERS ...] [PACKAGES ...]): one static library `skinforge_<name>` made of src/<name>/*.cpp.
function(skinforge_layer name)
  cmake_parse_arguments(LAYER "" "" "LAYERS;PACKAGES" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_SOURCE_DIR}/src/${name}/*.cpp")
  set(target skinforge_${name})
  if(sources)
    add_library(${target} STATIC ${sources})
    set(scope PUBLIC)
    target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:skinforge_warnings>)
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  target_compile_features(${target} ${scope} cxx_std_20)
  target_include_directories(${target} ${scope} "${CMAKE_SOURCE_DIR}/src")
  target_link_libraries(${target} ${scope} ${LAYER_PACKAGES} Threads::Threads)
  foreach(layer IN LISTS LAYER_LAYERS)
    target_link_libraries(${target} ${scope} skinforge_${layer})
  endforeach()
  foreach(package IN LISTS LAYER_PACKAGES)
    get_target_property(includes ${package} INTERFACE_INCLUDE_DIRECTORIES)
    if(includes)
      target_include_directories(${target} SYSTEM ${scope} ${includes})
    endif()
  endforeach()
endfunction()

# skinforge_layer_tests(<name> [<layer>]): one executable `skinforge_<name>_tests` made of tests/<name>/*.cpp, linked with
# a layer (default: the one of that name).
function(skinforge_layer_tests name)
  set(layer ${name})
  if(ARGC GREATER 1)
    set(layer ${ARGV1})
  endif()
  file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_SOURCE_DIR}/tests/${name}/*.cpp")
  if(NOT sources)
    return()
  endif()
  set(target skinforge_${name}_tests)
  add_executable(${target} ${sources})
  target_link_libraries(${target} PRIVATE skinforge_warnings skinforge_${layer} skinforge_testing GTest::gmock_main)
  target_compile_definitions(${target} PRIVATE
    SKINFORGE_SOURCE_DIR="${CMAKE_SOURCE_DIR}" SKINFORGE_BINARY="$<TARGET_FILE:skinforge>")
  add_test(NAME ${name} COMMAND ${target})
endfunction()
