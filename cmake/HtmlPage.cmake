# The page of src/html/page becomes part of the program; the 3D viewer, which needs npm packages, a file beside it.
set(page "${CMAKE_SOURCE_DIR}/src/html/page")
file(GLOB scripts CONFIGURE_DEPENDS "${page}/*.js")
set(sources "${CMAKE_BINARY_DIR}/generated/html/page_sources.cpp")
add_custom_command(OUTPUT "${sources}"
  DEPENDS ${scripts} "${page}/page.css" "${page}/page.html" "${CMAKE_SOURCE_DIR}/cmake/write_page_sources.cmake"
  COMMAND ${CMAKE_COMMAND} -DPAGE=${page} -DOUTPUT=${sources}
          -P "${CMAKE_SOURCE_DIR}/cmake/write_page_sources.cmake")
target_sources(skinforge_html PRIVATE "${sources}")

# three.js and our viewer in one compressed module. scripts/setup.sh --node brings the packages; without them reports
# have no 3D view.
set(SKINFORGE_NODE_MODULES "${CMAKE_SOURCE_DIR}/build/node/node_modules" CACHE PATH "npm packages: three, esbuild")
find_program(NODE node)
if(NODE AND EXISTS "${SKINFORGE_NODE_MODULES}/three" AND EXISTS "${SKINFORGE_NODE_MODULES}/esbuild")
  file(GLOB viewer CONFIGURE_DEPENDS "${CMAKE_SOURCE_DIR}/src/html/viewer/*.js")
  set(bundle "${CMAKE_BINARY_DIR}/skinforge_viewer.js.gz")
  add_custom_command(OUTPUT "${bundle}" DEPENDS ${viewer} "${CMAKE_SOURCE_DIR}/scripts/bundle_viewer.cjs"
    COMMAND ${NODE} "${CMAKE_SOURCE_DIR}/scripts/bundle_viewer.cjs" "${SKINFORGE_NODE_MODULES}"
            "${CMAKE_SOURCE_DIR}/src/html/viewer/viewer.js" "${bundle}")
  add_custom_target(skinforge_viewer ALL DEPENDS "${bundle}")
else()
  message(STATUS "no three and esbuild in ${SKINFORGE_NODE_MODULES}: reports get no 3D view (scripts/setup.sh --node)")
endif()
