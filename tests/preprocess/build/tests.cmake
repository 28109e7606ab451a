# Like tests/tools/image.
farcell_tests(preprocess/build ENVIRONMENT "ASAN_OPTIONS=detect_leaks=1:fast_unwind_on_malloc=0"
              DEPS farcell_preprocess_build farcell_tests_support_images PkgConfig::hwy APART sources_test.cpp)
