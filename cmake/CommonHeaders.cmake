# strut_common_headers(TARGET OWNER target MORE headers…): the headers of libraries that most sources include are compiled
# once, for the owner (strut_headers, or itself), and read from there by the others: a third of a build went to them.
# A source still includes what it names: the presets debug, asan and tsan compile each source alone.
function(strut_common_headers target)
  cmake_parse_arguments(headers "" "OWNER" "MORE" ${ARGN})
  set(owner strut_headers)
  if(headers_OWNER)
    set(owner ${headers_OWNER})
  endif()
  if(target STREQUAL owner)
    target_precompile_headers(${target} PRIVATE
      <Eigen/Dense> <algorithm> <array> <cmath> <cstdint> <filesystem> <fstream> <functional> <limits> <map> <memory>
      <numeric> <optional> <set> <span> <sstream> <stdexcept> <string> <string_view> <utility> <variant> <vector>
      ${headers_MORE})
  else()
    target_precompile_headers(${target} REUSE_FROM ${owner})
  endif()
  target_compile_options(${target} PRIVATE ${STRUT_SHARED_CODE})  # headers and their users must agree
  # GCC 12 takes what was compiled before for the project's own, and warns falsely of the std::string in it.
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND NOT CMAKE_DISABLE_PRECOMPILE_HEADERS)
    target_compile_options(${target} PRIVATE -Wno-array-bounds -Wno-stringop-overflow)
  endif()
endfunction()

# An owner that sees Eigen alone: GCC does not read what was compiled with a definition that others lack, as those that
# exported targets of Kokkos bring.
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/headers.cpp CONTENT "// Headers alone.\n")
add_library(strut_headers OBJECT ${CMAKE_BINARY_DIR}/headers.cpp)
target_link_libraries(strut_headers PRIVATE Eigen3::Eigen)
strut_common_headers(strut_headers)
