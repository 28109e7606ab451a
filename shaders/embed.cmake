# cmake -DROOT=<repository> -DOUTPUT=<file.cpp> -DFUNCTION=<namespace::name> -DFILES=<path;path;...> -P embed.cmake
# Writes C++ that holds the text of each file; paths are relative to ROOT.
set(entries "")
foreach(path ${FILES})
  file(READ ${ROOT}/${path} text)
  string(LENGTH "${text}" length)
  if(length GREATER 60000)
    message(FATAL_ERROR "${path} is longer than a string literal may be")
  endif()
  string(APPEND entries "    {\"${path}\", R\"~glsl~(${text})~glsl~\"},\n")
endforeach()
string(REGEX MATCH "^(.+)::([A-Za-z]+)$" matched ${FUNCTION})
file(WRITE ${OUTPUT} "#include <string_view>
#include <utility>

namespace ${CMAKE_MATCH_1} {
namespace {
constexpr std::pair<std::string_view, std::string_view> kFiles[] = {
${entries}};
}  // namespace

std::string_view ${CMAKE_MATCH_2}(std::string_view path);

std::string_view ${CMAKE_MATCH_2}(std::string_view path) {
  for (const auto& [name, text] : kFiles)
    if (name == path) return text;
  return {};
}

}  // namespace ${CMAKE_MATCH_1}
")
