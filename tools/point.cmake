add_executable(strut-point point.cpp point/path.cpp point/request.cpp)
target_include_directories(strut-point PRIVATE ${CMAKE_CURRENT_LIST_DIR})
target_link_libraries(strut-point PRIVATE strut_deck)
strut_common_headers(strut-point)
