add_executable(strut-mesh mesh.cpp mesh/recipe.cpp mesh/section.cpp mesh/body.cpp mesh/arrays.cpp)
target_include_directories(strut-mesh PRIVATE ${CMAKE_CURRENT_LIST_DIR})
target_link_libraries(strut-mesh PRIVATE strut_io)
