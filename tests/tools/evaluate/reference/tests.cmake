# Like tests/tools/image.
farcell_tests(tools/evaluate/reference ENVIRONMENT "ASAN_OPTIONS=detect_leaks=1:fast_unwind_on_malloc=0"
              DEPS farcell_tools_evaluate_reference farcell_preprocess_build farcell_tests_support_images)
