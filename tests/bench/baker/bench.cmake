find_package(embree 3.13 REQUIRED)
find_package(meshoptimizer REQUIRED)
pkg_check_modules(hwy REQUIRED IMPORTED_TARGET libhwy)
farcell_program(tests/bench/baker bench_baker DEPS farcell_preprocess_bake farcell_preprocess_read
                meshoptimizer::meshoptimizer PkgConfig::hwy embree)
target_compile_definitions(bench_baker PRIVATE FARCELL_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
