# Manual page and shell completion of every program, made by the program itself (--print-reference, see tools/reference)
# when it is built.

# Where they lie, and where installing takes them from: <program>.1.gz, <program>, _<program>, <program>.fish
set(reference_dir ${CMAKE_BINARY_DIR}/share)
set(man_dir ${reference_dir}/man/man1)
set(bash_dir ${reference_dir}/bash-completion/completions)
set(zsh_dir ${reference_dir}/zsh)
set(fish_dir ${reference_dir}/fish)

get_property(programs GLOBAL PROPERTY FARCELL_PROGRAMS)
set(references "")
foreach(program ${programs})
  set(made ${man_dir}/${program}.1.gz ${bash_dir}/${program} ${zsh_dir}/_${program} ${fish_dir}/${program}.fish)
  add_custom_command(
    OUTPUT ${made}
    COMMAND ${CMAKE_COMMAND} -DPROGRAM=$<TARGET_FILE:${program}> -DPAGE=${man_dir}/${program}.1
            -DBASH=${bash_dir}/${program} -DZSH=${zsh_dir}/_${program} -DFISH=${fish_dir}/${program}.fish
            -P ${CMAKE_SOURCE_DIR}/cmake/print_reference.cmake
    DEPENDS ${program} ${CMAKE_SOURCE_DIR}/cmake/print_reference.cmake
    COMMENT "Manual page and completion of ${program}"
    VERBATIM)
  list(APPEND references ${made})
endforeach()
# All that is installed: the programs and what they say of themselves.
add_custom_target(programs ALL DEPENDS ${references})
