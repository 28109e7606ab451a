find_package(embree 3.13 REQUIRED)
pkg_check_modules(hwy REQUIRED IMPORTED_TARGET libhwy)
farcell_tests(preprocess/bake DEPS farcell_preprocess_bake farcell_preprocess_read PkgConfig::hwy embree
              APART texture_test.cpp watertight_test.cpp)
