# The module `libskinforge_vdb.so` (src/field/vdb), loaded on demand from beside the program. The field layer
# carries its digest, so that the program's build id changes with the module and a foreign module is refused.
file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_SOURCE_DIR}/src/field/vdb/*.cpp")
add_library(skinforge_vdb MODULE ${sources})
target_include_directories(skinforge_vdb PRIVATE "${CMAKE_SOURCE_DIR}/src")
target_link_libraries(skinforge_vdb PRIVATE skinforge_warnings OpenVDB::openvdb Eigen3::Eigen fmt::fmt)
# A table of TBB's marks entries at work by pointers to nowhere; only clang's sanitizer minds.
target_compile_options(skinforge_vdb PRIVATE $<$<CXX_COMPILER_ID:Clang>:-fno-sanitize=alignment>)
# Symbols stay visible: OpenVDB's templates share statics with its library.
set_target_properties(skinforge_vdb PROPERTIES LIBRARY_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}")
foreach(package OpenVDB::openvdb Eigen3::Eigen)
  get_target_property(includes ${package} INTERFACE_INCLUDE_DIRECTORIES)
  if(includes)
    target_include_directories(skinforge_vdb SYSTEM PRIVATE ${includes})
  endif()
endforeach()

set(header "${CMAKE_BINARY_DIR}/generated/field/vdb_module_id.h")
add_custom_command(OUTPUT "${header}" DEPENDS skinforge_vdb "${CMAKE_SOURCE_DIR}/cmake/write_module_id.cmake"
  COMMAND ${CMAKE_COMMAND} -DMODULE=$<TARGET_FILE:skinforge_vdb> -DHEADER=${header}
          -P "${CMAKE_SOURCE_DIR}/cmake/write_module_id.cmake")
target_sources(skinforge_field PRIVATE "${header}")
target_include_directories(skinforge_field PRIVATE "${CMAKE_BINARY_DIR}/generated")
target_link_libraries(skinforge_field PUBLIC ${CMAKE_DL_LIBS})
