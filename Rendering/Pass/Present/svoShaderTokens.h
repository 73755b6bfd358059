// Whole tokens in the text of a shader.
#ifndef svoShaderTokens_h
#define svoShaderTokens_h

#include <cctype>
#include <cstddef>
#include <string>

namespace svo
{
inline bool isIdentifier(char c)
{
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

/// Renames a whole token; true if it was there.
inline bool renameToken(std::string& text, const std::string& from, const std::string& to)
{
  bool found = false;
  std::size_t at = 0;
  while ((at = text.find(from, at)) != std::string::npos)
  {
    const std::size_t end = at + from.size();
    if ((at == 0 || !isIdentifier(text[at - 1])) &&
      (end >= text.size() || !isIdentifier(text[end])))
    {
      text.replace(at, from.size(), to);
      at += to.size();
      found = true;
    }
    else
    {
      at = end;
    }
  }
  return found;
}

/// True if `text` has `name` as a whole token.
inline bool hasToken(std::string text, const std::string& name)
{
  return renameToken(text, name, name);
}
}

#endif
