# cmake --install: a tree that runs. Programs in bin; tools, decks and pages side by side, as in the sources, in
# share/strut, where tools/run finds the programs.
include(GNUInstallDirs)
set(STRUT_SHARE ${CMAKE_INSTALL_DATADIR}/strut)

set(programs strut)
if(STRUT_TOOLS)
  list(APPEND programs strut-mesh strut-compare strut-point strut-evaluate)
endif()
set_target_properties(${programs} PROPERTIES INSTALL_RPATH_USE_LINK_PATH ON)
install(TARGETS ${programs} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})

install(DIRECTORY tools DESTINATION ${STRUT_SHARE} USE_SOURCE_PERMISSIONS
        REGEX "\\.(cpp|hpp|cmake)$|CMakeLists.txt|__pycache__|/(prepare|test|site|packages(-[a-z]+)?)$" EXCLUDE)
install(DIRECTORY inputs DESTINATION ${STRUT_SHARE} USE_SOURCE_PERMISSIONS
        REGEX "\\.(g|e|csv|png|log|restart|restart\\.old)$" EXCLUDE)  # what runs have left
install(DIRECTORY docs DESTINATION ${STRUT_SHARE})
install(FILES README.md CHANGELOG.md LICENSE CITATION.cff DESTINATION ${STRUT_SHARE})
