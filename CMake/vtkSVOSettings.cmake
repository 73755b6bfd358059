# What follows from the settings and figures in Rendering/Settings.cmake, whose head says what an entry has: the code, in
# the build tree, of whoever calls vtksvo_configure_settings(), and the guide's tables (Testing/House/TestSettings.py).
set(VTKSVO_SETTINGS "${CMAKE_CURRENT_LIST_DIR}/../Rendering/Settings.cmake")

# What is made of the entries, by the names that templates use.
set(VTKSVO_SETTINGS_PARTS
  PROPERTIES MEMBERS PRINT PARAVIEW_DEFAULTS ENUMERATIONS FIELDS TO_FIELDS COMPARED AGREED TO_AGREED FROM_AGREED VIEW_PROPERTIES
  STATISTICS VALUES VIEW_STATISTICS PANEL_FIRST PANEL_DEFAULT PANEL_ADVANCED TABLE_speed TABLE_shadows TABLE_time TABLE_host)
function (vtksvo_append text part)
  set_property(GLOBAL APPEND_STRING PROPERTY "VTKSVO_${part}" "${text}")
endfunction ()

# "ShadowBuffer" -> "Shadow Buffer"
function (vtksvo_words name result)
  string(REGEX REPLACE "([a-z])([A-Z])" "\\1 \\2" words "${name}")
  string(REPLACE "Open GL" "OpenGL" words "${words}")
  set(${result} "${words}" PARENT_SCOPE)
endfunction ()

function (vtksvo_setting name type default)
  cmake_parse_arguments(PARSE_ARGV 3 arg
    "AGREED" "TABLE;UNIT;FIELD;TYPE;CHANGES;PANEL;PARAVIEW;LABEL;WIDGET;SAYS;MORE" "RANGE;CHOICES")
  if (arg_UNPARSED_ARGUMENTS OR NOT arg_SAYS OR NOT arg_TABLE MATCHES "^(speed|shadows|time|host)$"
      OR (arg_FIELD AND NOT arg_CHANGES MATCHES "^(rays|shadows|look|nothing)$"))
    message(FATAL_ERROR "Rendering/Settings.cmake: the entry of ${name} is not complete: ${arg_UNPARSED_ARGUMENTS}")
  endif ()
  if (type STREQUAL "memory")
    set(arg_RANGE 0 "VTK_ID_MAX / 1024")
    set(arg_UNIT KiB)
  endif ()
  if (arg_RANGE)
    list(GET arg_RANGE 0 least)
    list(GET arg_RANGE 1 most)
  endif ()
  set(comment "${arg_SAYS}")
  if (arg_MORE)
    string(APPEND comment "\n${arg_MORE}")
  endif ()
  string(REGEX REPLACE "\n *" " " line "${comment}")
  string(REGEX REPLACE "\n *" "\n   * " comment "${comment}")
  string(REGEX REPLACE "\n *" " " help "${arg_SAYS}")
  string(REPLACE "`" "" help "${help}")

  # The property.
  set(enumeration "")
  set(tail "")
  set(range "")
  set(shown "${default}")
  set(unit "${arg_UNIT}")
  set(get "vtkGetMacro(${name}, @cxx@);")
  set(member "${name} = ${default}")
  set(print "this->${name}")
  if (type STREQUAL "vector")
    set(cxx double)
    set(shown "(${default})")
    set(set "virtual void Set${name}(double x, double y, double z)
  {
    this->SetVector(\"${name}\", x, y, z, this->${name});
  }
  virtual void Set${name}(const double value[3])
  {
    this->Set${name}(value[0], value[1], value[2]);
  }")
    set(get "vtkGetVector3Macro(${name}, double);")
    set(member "${name}[3] = { ${default} }")
    set(print "this->${name}[0] << ' ' << this->${name}[1] << ' ' << this->${name}[2]")
  elseif (type STREQUAL "bool")
    set(cxx bool)
    set(shown "off")
    if (default)
      set(shown "on")
    endif ()
    set(unit "bool")
    set(set "vtkSetMacro(${name}, bool);")
    set(tail "  vtkBooleanMacro(${name}, bool);\n")
  elseif (type STREQUAL "double")
    set(cxx double)
    set(set "virtual void Set${name}(double value)
  {
    this->SetNumber(\"${name}\", value, ${least}, ${most}, this->${name});
  }
  virtual double Get${name}MinValue() { return ${least}; }
  virtual double Get${name}MaxValue() { return ${most}; }")
  elseif (type STREQUAL "choice")
    set(cxx int)
    set(rest ${arg_CHOICES})
    set(value 0)
    set(names "")
    set(enumerators "")
    set(field_enumerators "")
    set(entries "")
    while (rest)
      list(POP_FRONT rest enumerator chosen)
      vtksvo_words("${chosen}" words)
      list(APPEND enumerators "    ${enumerator} = ${value}")
      string(REGEX MATCH "_(.)(.*)" words_of "${enumerator}")
      string(TOLOWER "${CMAKE_MATCH_2}" others)
      list(APPEND field_enumerators "  ${CMAKE_MATCH_1}${others}")
      string(APPEND entries "          <Entry value=\"${value}\" text=\"${words}\"/>\n")
      string(APPEND tail "  void Set${name}To${chosen}() { this->Set${name}(${enumerator}); }\n")
      list(APPEND names "${chosen}")
      if (enumerator STREQUAL default)
        set(shown "${chosen}")
        set(number "${value}")
      endif ()
      math(EXPR value "${value} + 1")
    endwhile ()
    set(least 0)
    math(EXPR most "${value} - 1")
    list(JOIN enumerators ",\n" enumeration)
    set(enumeration "  enum ${name}Type\n  {\n${enumeration}\n  };\n\n")
    string(REPLACE ";" ", " unit "${names}")
    set(set "vtkSetClampMacro(${name}, int, ${least}, ${most});")
  else ()
    set(cxx int)
    if (type STREQUAL "memory")
      set(cxx vtkIdType)
      math(EXPR amount "${default} / 1024")
      set(amount_unit MiB)
      if (amount GREATER_EQUAL 1024)
        math(EXPR amount "${amount} / 1024")
        set(amount_unit GiB)
      endif ()
      set(shown "${default} (${amount} ${amount_unit})")
    endif ()
    set(set "vtkSetClampMacro(${name}, ${cxx}, ${least}, ${most});")
  endif ()
  if (type MATCHES "^(int|double)$")
    set(range "${least}..${most}")
    if (unit)
      set(range "${unit}, ${range}")
    endif ()
    set(unit "${range}")
  endif ()
  string(REPLACE "@cxx@" "${cxx}" get "${get}")
  vtksvo_append("${enumeration}  //@{
  /**
   * ${comment}
   * ${unit}. Default ${shown}.
   */
  ${set}
  ${get}
${tail}  //@}

" PROPERTIES)
  vtksvo_append("  ${cxx} ${member};\n" MEMBERS)
  set(printed_unit "")
  if (arg_UNIT)
    set(printed_unit " ${arg_UNIT}")
  endif ()
  vtksvo_append("  os << indent << \"${name}: \" << ${print} << \"${printed_unit}\\n\";\n" PRINT)
  if (arg_PARAVIEW)
    vtksvo_append("  this->Set${name}(${arg_PARAVIEW});\n" PARAVIEW_DEFAULTS)
  endif ()

  # What the tracer has of it.
  if (arg_FIELD)
    set(value "this->${name}")
    set(initial "${default}")
    set(field_type "${cxx}")
    if (type STREQUAL "memory")
      set(field_type "std::size_t")
      set(value "static_cast<std::size_t>(${value}) * 1024")
      set(initial "std::size_t(${default}) * 1024")
    elseif (type STREQUAL "vector")
      set(field_type "glm::dvec3")
      set(value "glm::dvec3(this->${name}[0], this->${name}[1], this->${name}[2])")
      set(initial "glm::dvec3(${default})")
    elseif (type STREQUAL "choice")
      set(field_type "${arg_TYPE}")
      list(JOIN field_enumerators ",\n" field_enumerators)
      vtksvo_append("enum class ${arg_TYPE}\n{\n${field_enumerators}\n};\n\n" ENUMERATIONS)
      set(value "static_cast<svo::${arg_TYPE}>(${value})")
      set(initial "static_cast<${arg_TYPE}>(${number})")
    endif ()
    string(REGEX REPLACE "\n *" "\n  /// " field_comment "${arg_SAYS}")
    vtksvo_append("  /// ${field_comment}\n  ${field_type} ${arg_FIELD} = ${initial};\n" FIELDS)
    vtksvo_append("  settings.${arg_FIELD} = ${value};\n" TO_FIELDS)
    if (NOT arg_CHANGES STREQUAL "nothing")
      vtksvo_append("  visit(settings.${arg_FIELD});\n" COMPARED)
    endif ()
    if (arg_AGREED)
      vtksvo_append("  double ${arg_FIELD};\n" AGREED)
      vtksvo_append("  agreed.${arg_FIELD} = settings.${arg_FIELD};\n" TO_AGREED)
      vtksvo_append("  settings.${arg_FIELD} = static_cast<${field_type}>(agreed.${arg_FIELD});\n" FROM_AGREED)
    endif ()
  endif ()

  # ParaView's property of a view.
  set(in_paraview "")
  if (arg_PANEL)
    if (NOT arg_LABEL)
      vtksvo_words("${name}" arg_LABEL)
    endif ()
    set(in_paraview "yes")
    set(visibility "")
    if (arg_PANEL STREQUAL "advanced")
      set(in_paraview "advanced")
      set(visibility " panel_visibility=\"advanced\"")
    endif ()
    if (arg_WIDGET)
      string(APPEND visibility " panel_widget=\"${arg_WIDGET}\"")
    endif ()
    if (type STREQUAL "double")
      set(vector Double)
      set(domain "<DoubleRangeDomain name=\"range\" min=\"${least}\" max=\"${most}\"/>")
    else ()
      set(vector Int)
      set(domain "<IntRangeDomain name=\"range\" min=\"${least}\" max=\"${most}\"/>")
    endif ()
    set(initial "${default}")
    set(elements 1)
    if (type STREQUAL "vector")
      set(vector Double)
      set(elements 3)
      set(domain "<DoubleRangeDomain name=\"range\"/>")
      string(REPLACE "," "" initial "${default}")
    elseif (type STREQUAL "bool")
      set(domain "<BooleanDomain name=\"bool\"/>")
      set(initial 0)
      if (default)
        set(initial 1)
      endif ()
    elseif (type STREQUAL "choice")
      set(domain "<EnumerationDomain name=\"enum\">\n${entries}        </EnumerationDomain>")
      set(initial "${number}")
    elseif (type STREQUAL "memory")
      set(domain "<IntRangeDomain name=\"range\" min=\"0\"/>")
      string(APPEND help " In KiB.")
    endif ()
    if (arg_PARAVIEW)
      set(initial "${arg_PARAVIEW}")
      string(APPEND shown "; in ParaView ${arg_PARAVIEW}")
    endif ()
    string(REPLACE "&" "&amp;" help "${help}")
    string(REPLACE "<" "&lt;" help "${help}")
    string(TOUPPER "${arg_PANEL}" panel)
    vtksvo_append("      <${vector}VectorProperty name=\"SVO${name}\" command=\"Set${name}\" label=\"SVO ${arg_LABEL}\"
                         si_class=\"vtkSISVOViewProperty\"
                         number_of_elements=\"${elements}\" default_values=\"${initial}\"${visibility}>
        ${domain}
        <Documentation>
          ${help}
        </Documentation>
      </${vector}VectorProperty>
" VIEW_PROPERTIES)
    vtksvo_append("        <Property name=\"SVO${name}\"/>\n" PANEL_${panel})
  endif ()
  vtksvo_append("| `${name}` | ${unit} | ${shown} | ${in_paraview} | ${line} |\n" TABLE_${arg_TABLE})
endfunction ()

function (vtksvo_statistic name type)
  cmake_parse_arguments(PARSE_ARGV 2 arg "PARAVIEW" "UNIT;OF;SAYS" "")
  if (arg_UNPARSED_ARGUMENTS OR NOT arg_SAYS)
    message(FATAL_ERROR "Rendering/Settings.cmake: the entry of ${name} is not complete: ${arg_UNPARSED_ARGUMENTS}")
  endif ()
  set(cxx "${type}")
  set(value "frame.${arg_OF}")
  if (type STREQUAL "memory")
    set(cxx vtkIdType)
    set(value "(${value}) / 1024")
    set(arg_UNIT KiB)
  endif ()
  set(unit "")
  if (arg_UNIT)
    set(unit " ${arg_UNIT}")
  endif ()
  string(REGEX REPLACE "\n *" " " help "${arg_SAYS}")
  if (arg_OF)
    string(REGEX REPLACE "\n *" "\n   * " comment "${arg_SAYS}")
    vtksvo_append("  /**
   * ${comment}
   */
  ${cxx} Get${name}() const;

" STATISTICS)
    vtksvo_append("
${cxx} vtkSVOPassSettings::Get${name}() const
{
  const svo::PassStatistics& frame = this->LastFrame();
  return static_cast<${cxx}>(${value});
}
" VALUES)
    vtksvo_append("  os << indent << \"${name}: \" << this->Get${name}() << \"${unit}\\n\";\n" PRINT)
  endif ()
  if (arg_PARAVIEW)
    vtksvo_append("      <SVOViewInformationProperty name=\"SVO${name}\" command=\"Get${name}\" label=\"SVO${name}\"
                            si_class=\"vtkSISVOViewProperty\" information_only=\"1\">
        <SimpleDoubleInformationHelper/>
        <Documentation>${help}</Documentation>
      </SVOViewInformationProperty>
" VIEW_STATISTICS)
  endif ()
endfunction ()

# Fills in what the template names of the above as @VTKSVO_...@.
function (vtksvo_configure_settings template output)
  foreach (part IN LISTS VTKSVO_SETTINGS_PARTS)
    set_property(GLOBAL PROPERTY "VTKSVO_${part}" "")
  endforeach ()
  include("${VTKSVO_SETTINGS}")
  foreach (part IN LISTS VTKSVO_SETTINGS_PARTS)
    get_property(VTKSVO_${part} GLOBAL PROPERTY "VTKSVO_${part}")
  endforeach ()
  configure_file("${template}" "${output}" @ONLY)
endfunction ()
