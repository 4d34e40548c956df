# cmake --install: a tree that runs. Programs in bin; tools, decks and pages side by side, as in the sources, in
# share/strut, where tools/run finds the programs. cpack: the same as a package of Debian.
include(GNUInstallDirs)
set(STRUT_SHARE ${CMAKE_INSTALL_DATADIR}/strut)

set(programs strut)
if(STRUT_TOOLS)
  list(APPEND programs strut-mesh strut-point strut-evaluate)
endif()
if(STRUT_PYTHON)
  list(APPEND modules strut_python)
endif()
set_target_properties(${programs} ${modules} PROPERTIES INSTALL_RPATH_USE_LINK_PATH ON)
install(TARGETS ${programs} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
if(STRUT_PYTHON)
  # The folder of Debian's Python 3, whatever its minor version; elsewhere it goes into PYTHONPATH, or where a user puts it.
  set(STRUT_PYTHON_FOLDER lib/python3/dist-packages CACHE STRING "folder of Python's packages in the prefix")
  install(TARGETS strut_python LIBRARY DESTINATION ${STRUT_PYTHON_FOLDER}/strut)
  install(DIRECTORY tools/python/strut DESTINATION ${STRUT_PYTHON_FOLDER} FILES_MATCHING PATTERN "*.py" PATTERN __pycache__ EXCLUDE)
endif()

# The program's --help as a man page, and as a script for the shell's completion.
set(pages ${CMAKE_BINARY_DIR}/pages)
add_custom_command(OUTPUT ${pages}/strut.1 ${pages}/strut
                   COMMAND ${CMAKE_COMMAND} -E make_directory ${pages}
                   COMMAND ${CMAKE_SOURCE_DIR}/cmake/from_help.sh ${PROJECT_VERSION} $<TARGET_FILE:strut> ${pages}/strut.1 ${pages}/strut
                   DEPENDS strut cmake/from_help.sh VERBATIM)
add_custom_target(pages ALL DEPENDS ${pages}/strut.1)
install(FILES ${pages}/strut.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 OPTIONAL)
install(FILES ${pages}/strut DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions OPTIONAL)

install(DIRECTORY tools DESTINATION ${STRUT_SHARE} USE_SOURCE_PERMISSIONS
        REGEX "\\.(cpp|hpp|cmake)$|CMakeLists.txt|__pycache__|/(mesh|point|python)$|/(prepare|test|site|packages(-[a-z]+)?)$" EXCLUDE)
# A tool in Python that is also found as a program.
file(RELATIVE_PATH compare ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_DATADIR}/strut/tools/strut-compare)
file(MAKE_DIRECTORY ${pages})
file(CREATE_LINK ${compare} ${pages}/strut-compare SYMBOLIC)
install(FILES ${pages}/strut-compare DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY inputs DESTINATION ${STRUT_SHARE} USE_SOURCE_PERMISSIONS
        REGEX "\\.(g|e|csv|png|log|restart|restart\\.old)$" EXCLUDE)  # what runs have left
install(DIRECTORY materials/abaqus DESTINATION ${STRUT_SHARE}/materials)  # for laws of one's own
install(FILES materials/strut_law.h materials/README.md DESTINATION ${STRUT_SHARE}/materials)
install(FILES tools/python/README.md DESTINATION ${STRUT_SHARE}/tools/python)
install(DIRECTORY docs DESTINATION ${STRUT_SHARE})
install(FILES README.md CONTRIBUTING.md CHANGELOG.md LICENSE CITATION.cff DESTINATION ${STRUT_SHARE})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_NAME strut)
set(CPACK_PACKAGE_CONTACT "The strut developers <strut@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "correspondence peridynamics of crushing foams and metal bars")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)  # the libraries of programs and module; the rest is what tools and module import
set(CPACK_DEBIAN_PACKAGE_DEPENDS "openmpi-bin, python3, python3-numpy, python3-scipy, python3-matplotlib, python3-netcdf4")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3-mpi4py, python3-pandas, python3-vtk9, python3-tifffile, python3-h5py, python3-meshio")
set(CPACK_STRIP_FILES ON)
include(CPack)
