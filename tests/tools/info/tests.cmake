farcell_tests(tools/info DEPS farcell_cache_pack farcell_tools_report)
if(TARGET tools_info_test)
  add_dependencies(tools_info_test farcell-info farcell-verify)
endif()
