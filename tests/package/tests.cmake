# What an installed farcell is made of, asked from outside.
get_property(programs GLOBAL PROPERTY FARCELL_PROGRAMS)
string(REPLACE ";" " " program_names "${programs}")
farcell_tests(package)
target_compile_definitions(package_test PRIVATE FARCELL_PROGRAM_NAMES="${program_names}"
                                                FARCELL_REFERENCE_DIR="${reference_dir}")
add_dependencies(package_test programs)

# Sanitized programs are not for installing.
if(NOT FARCELL_SANITIZE)
  add_test(NAME Package.InstalledAnywhereItWorksWithoutTheBuild
           COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/package/install_test.sh ${CMAKE_BINARY_DIR} ${CMAKE_SOURCE_DIR}
                   ${programs})
  add_test(NAME Package.TheDebianPackageIsComplete
           COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/package/debian_test.sh ${CMAKE_BINARY_DIR} ${PROJECT_VERSION})
  # Both write the list of what was installed into the build.
  set_tests_properties(Package.InstalledAnywhereItWorksWithoutTheBuild Package.TheDebianPackageIsComplete
                       PROPERTIES LABELS package SKIP_RETURN_CODE 77 RESOURCE_LOCK installing)
endif()
