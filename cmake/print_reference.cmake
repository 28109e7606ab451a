# cmake -DPROGRAM=<program> -DPAGE=<page.1> -DBASH=<file> -DZSH=<file> -DFISH=<file> -P print_reference.cmake
# Writes what the program says of itself into the files; the manual page is compressed, to <page.1.gz>.

# Leaks are for the tests to find; printing must not fail by those of libraries.
set(ENV{ASAN_OPTIONS} detect_leaks=0)

function(print form file)
  get_filename_component(directory ${file} DIRECTORY)
  file(MAKE_DIRECTORY ${directory})
  execute_process(COMMAND ${PROGRAM} --print-reference ${form} OUTPUT_FILE ${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

print(man ${PAGE})
print(bash ${BASH})
print(zsh ${ZSH})
print(fish ${FISH})
# -n: neither name nor time goes into the file: the same page is the same bytes.
execute_process(COMMAND gzip -9nf ${PAGE} COMMAND_ERROR_IS_FATAL ANY)
