# strut_room(NAME SOURCES … SEES … READS … PRIVATE …): the library strut_NAME of the folder it is called from.
# Its headers are reached as "NAME/header.hpp" through a folder that holds a link to this room alone, so the rooms
# a target can include are exactly those it names (and what these see). SEES also links them; READS takes types from
# their headers without linking them: the deck needs that for the conditions, laws and formulations that it names.
function(strut_room name)
  cmake_parse_arguments(room "" "" "SOURCES;SEES;READS;PRIVATE" ${ARGN})
  set(includes ${CMAKE_BINARY_DIR}/rooms/${name})
  file(MAKE_DIRECTORY ${includes})
  file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR} ${includes}/${name} SYMBOLIC)
  add_library(strut_${name} STATIC ${room_SOURCES})
  target_include_directories(strut_${name} PUBLIC ${includes})
  foreach(room IN LISTS room_READS)
    target_include_directories(strut_${name} PUBLIC ${CMAKE_BINARY_DIR}/rooms/${room})
  endforeach()
  list(TRANSFORM room_SEES PREPEND strut_)
  target_link_libraries(strut_${name} PUBLIC ${room_SEES} PRIVATE ${room_PRIVATE})
  strut_common_headers(strut_${name})
endfunction()
