add_executable(strut-evaluate evaluate.cpp)
target_link_libraries(strut-evaluate PRIVATE strut_base)
