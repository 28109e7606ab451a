# Like tests/tools/image.
farcell_tests(preprocess/texture ENVIRONMENT "ASAN_OPTIONS=detect_leaks=1:fast_unwind_on_malloc=0"
              DEPS farcell_preprocess_texture farcell_tests_support_images)
