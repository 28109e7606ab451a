farcell_tests(tools/build DEPS farcell_preprocess_read farcell_cache_pack nlohmann_json::nlohmann_json)
if(TARGET tools_build_test)
  add_dependencies(tools_build_test farcell-build farcell-info farcell_io_faults)
  if(TARGET farcell-build-mpi)
    add_dependencies(tools_build_test farcell-build-mpi)
  endif()
  target_compile_definitions(tools_build_test PRIVATE FARCELL_IO_FAULTS="$<TARGET_FILE:farcell_io_faults>"
                             $<$<BOOL:${FARCELL_SANITIZE}>:FARCELL_SANITIZED>)
endif()
