# A leak of OpenImageIO that tests/support/lsan.supp names by its caller: only the slow unwinder sees callers outside our
# own code (and it cannot be used everywhere: it waits for ever beside the threads of Mesa).
farcell_tests(tools/image ENVIRONMENT "ASAN_OPTIONS=detect_leaks=1:fast_unwind_on_malloc=0" DEPS farcell_tools_image)
