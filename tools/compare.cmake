add_executable(strut-compare compare.cpp compare/series.cpp compare/difference.cpp)
target_include_directories(strut-compare PRIVATE ${CMAKE_CURRENT_LIST_DIR})
target_link_libraries(strut-compare PRIVATE strut_io)
strut_common_headers(strut-compare)
