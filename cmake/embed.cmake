# cmake -DROOT=<repository> -DOUTPUT=<file.cpp> -DHEADER=<path> -DFUNCTION=<name> -DFILES=<path;path;...> -P embed.cmake
# Writes C++ that holds the text of each file; paths are relative to ROOT. HEADER declares
# std::string_view farcell::FUNCTION(std::string_view path).
set(entries "")
foreach(path ${FILES})
  file(READ ${ROOT}/${path} text)
  string(LENGTH "${text}" length)
  if(length GREATER 60000)
    message(FATAL_ERROR "${path} is longer than a string literal may be")
  endif()
  string(APPEND entries "    {\"${path}\", R\"~text~(${text})~text~\"},\n")
endforeach()
file(WRITE ${OUTPUT} "#include \"${HEADER}\"

#include <utility>

namespace farcell {
namespace {
constexpr std::pair<std::string_view, std::string_view> kFiles[] = {
${entries}};
}  // namespace

std::string_view ${FUNCTION}(std::string_view path) {
  for (const auto& [name, text] : kFiles)
    if (name == path) return text;
  return {};
}

}  // namespace farcell
")
