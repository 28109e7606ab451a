# What `cmake --install` and `cpack` take: the programs and what they say of themselves, never tests or benchmarks.
# farcell-build-mpi stays in the build: a package should not depend on an MPI, and a cluster has its own.
# Components: `farcell` for both; `plain` for an installation without a package; `debian` for the package.

get_property(programs GLOBAL PROPERTY FARCELL_PROGRAMS)
install(TARGETS ${programs} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT farcell)
foreach(program ${programs})
  install(FILES ${man_dir}/${program}.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT farcell)
  install(FILES ${bash_dir}/${program} DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
          COMPONENT farcell)
  install(FILES ${fish_dir}/${program}.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d
          COMPONENT farcell)
  install(FILES ${zsh_dir}/_${program} DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions COMPONENT plain)
  install(FILES ${zsh_dir}/_${program} DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions
          COMPONENT debian EXCLUDE_FROM_ALL)
endforeach()
install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT farcell)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT plain)

# The Debian package: farcell_<version>_<architecture>.deb.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "farcell contributors <contributors@farcell.example>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "walk through 3D models larger than memory")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
    "farcell builds a pack from a 3D model of any size: a city, a scanned statue.
It draws pictures of the pack, near parts as triangles and far parts as
prefiltered orthographic images corrected by depth, and measures in numbers
how far each picture is from the full geometry and what it cost.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL farcell debian)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
# Libraries that are linked are found by their symbols; OpenGL is opened at run time, in software where there is no GPU.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libegl1, libopengl0 | libgl1, libgl1-mesa-dri")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

# debian_file(<name in cmake/debian>): with its @variables@ filled in.
function(debian_file name)
  configure_file(${CMAKE_SOURCE_DIR}/cmake/debian/${name}.in ${CMAKE_BINARY_DIR}/debian/${name} @ONLY)
endfunction()

file(READ LICENSE licence)
string(REGEX MATCH "\nCopyright \\(c\\) ([^\n]*)\n" found "${licence}")
set(copyright ${CMAKE_MATCH_1})
string(REGEX REPLACE "^.*\n(Permission is hereby)" "\\1" licence "${licence}")
string(STRIP "${licence}" licence)
string(REPLACE "\n\n" "\n.\n" licence "${licence}")
string(REPLACE "\n" "\n " licence " ${licence}")
debian_file(copyright)
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
debian_file(changelog)
execute_process(COMMAND gzip -9nkf ${CMAKE_BINARY_DIR}/debian/changelog COMMAND_ERROR_IS_FATAL ANY)
install(FILES ${CMAKE_BINARY_DIR}/debian/copyright ${CMAKE_BINARY_DIR}/debian/changelog.gz
        DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT debian EXCLUDE_FROM_ALL)
include(CPack)
