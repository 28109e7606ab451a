# What an installed farcell is made of, asked from outside.
get_property(program_names GLOBAL PROPERTY FARCELL_PROGRAMS)
string(REPLACE ";" " " program_names "${program_names}")
farcell_tests(package)
target_compile_definitions(package_test PRIVATE FARCELL_PROGRAM_NAMES="${program_names}"
                                                FARCELL_REFERENCE_DIR="${reference_dir}")
add_dependencies(package_test programs)
