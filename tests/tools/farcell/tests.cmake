farcell_tests(tools/farcell)
if(TARGET tools_farcell_test)
  add_dependencies(tools_farcell_test farcell)
endif()
