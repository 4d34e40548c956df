# The parts that a test of their own can link.
add_library(strut_foam STATIC mesh/tessellation.cpp mesh/levels.cpp mesh/lattices.cpp mesh/struts.cpp mesh/voxels.cpp mesh/pieces.cpp mesh/merging.cpp
            mesh/flat_cells.cpp mesh/cells.cpp mesh/cell_mesh.cpp)
target_include_directories(strut_foam PUBLIC ${CMAKE_CURRENT_LIST_DIR})
target_include_directories(strut_foam SYSTEM PRIVATE ${VORO_INCLUDE_DIR})
target_link_libraries(strut_foam PUBLIC strut_io PRIVATE ${VORO_LIBRARY})
strut_common_headers(strut_foam)
# The same seed gives the same foam on any machine, with fused multiply-add or without.
target_compile_options(strut_foam PRIVATE -ffp-contract=off)

add_library(strut_recipe STATIC mesh/recipe.cpp mesh/section.cpp mesh/layers.cpp mesh/body.cpp mesh/foam.cpp mesh/resolution.cpp mesh/arrays.cpp)
target_link_libraries(strut_recipe PUBLIC strut_foam)
target_include_directories(strut_recipe PRIVATE ${CMAKE_BINARY_DIR}/rooms/mechanics)  # a table of it, in a header alone
strut_common_headers(strut_recipe)

add_executable(strut-mesh mesh.cpp)
target_link_libraries(strut-mesh PRIVATE strut_recipe)
strut_common_headers(strut-mesh)
