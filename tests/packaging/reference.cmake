# The reference of the C99 interface: every exported function must have a page that describes its purpose, effects and
# return value, and incomplete headers must be rejected. Run by CTest:
#   cmake -DTOOL=…/phasetree-reference -DPAGES=…/man3 -DLIBRARY=…/libphasetree_embree3.so -DHEADERS=…/include/phasetree
#         -DWORK=… -P reference.cmake
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/checks.cmake)
file(REMOVE_RECURSE "${WORK}")

# The page of a name, with links resolved.
function(read_page name)
    if(NOT EXISTS "${PAGES}/${name}.3")
        message(FATAL_ERROR "${name} has no manual page in ${PAGES}")
    endif()
    file(READ "${PAGES}/${name}.3" page)
    if(page MATCHES "^\\.so man3/(.*)\\.3\n$")
        file(READ "${PAGES}/${CMAKE_MATCH_1}.3" page)
    endif()
    set(page "${page}" PARENT_SCOPE)
endfunction()

# The content of a page under a heading.
function(section heading)
    string(REGEX MATCH "\n\\.SH \"${heading}\"\n(.*)" rest "${page}")
    string(REGEX REPLACE "\n\\.SH .*" "" rest "${CMAKE_MATCH_1}")
    set(section "${rest}" PARENT_SCOPE)
endfunction()

run(nm -D --defined-only "${LIBRARY}")
string(REGEX MATCHALL "phasetree[A-Z][A-Za-z]*" functions "${output}")
list(LENGTH functions count)
if(count LESS 30)
    message(FATAL_ERROR "only ${count} functions are exported:\n${output}")
endif()
# Also inline functions, which are not exported, and structures.
file(GLOB headers "${HEADERS}/embree/*.h")
foreach(header ${headers})
    file(STRINGS "${header}" lines REGEX "^static inline|^typedef (struct|enum) [A-Za-z]+ {")
    foreach(line ${lines})
        string(REGEX MATCH "([A-Za-z]+)(\\(| {)" name "${line}")
        list(APPEND functions ${CMAKE_MATCH_1})
    endforeach()
endforeach()
foreach(function ${functions})
    read_page(${function})
    section(NAME)
    if(NOT section MATCHES "(^|, )${function}(,.*)? \\\\- [^ ].....")
        message(FATAL_ERROR "The page of ${function} does not begin with its name and a summary:\n${page}")
    endif()
    section(SYNOPSIS)
    if(NOT section MATCHES "#include <phasetree/phasetree_embree.h>.*[ *}]${function}[(;]")
        message(FATAL_ERROR "The page of ${function} does not show its declaration:\n${page}")
    endif()
    section(DESCRIPTION)
    if(NOT section MATCHES "[^ ]..........")
        message(FATAL_ERROR "The page of ${function} does not describe it:\n${page}")
    endif()
    section("RETURN VALUE")
    if(function MATCHES "^p" AND NOT section MATCHES "[^ ].......")
        message(FATAL_ERROR "The page of ${function} does not say what it returns:\n${page}")
    endif()
endforeach()

# A complete sample page.
read_page(phasetreeSetGeometryShownPhases)
expect("${page}" "phasetreeSetGeometryShownPhases \\- Sets the phases to show" "    PhasetreePhaseSet shownPhases)"
    ".SH \"ERRORS\"\n.TP\n.B PHASETREE_ERROR_INVALID_ARGUMENT\nan opaque phase is missing from the set\n"
    ".BR PhasetreeGeometryOptions (3)")

# groff must not report any warnings.
find_program(groff groff)
if(groff)
    set(pages "")
    foreach(function ${functions} phasetree_embree)
        file(READ "${PAGES}/${function}.3" page)
        if(NOT page MATCHES "^\\.so ")
            list(APPEND pages "${PAGES}/${function}.3")
        endif()
    endforeach()
    run("${groff}" -man -Tutf8 -Kutf8 -ww -z ${pages})
    if(errors)
        message(FATAL_ERROR "groff says of the pages:\n${errors}")
    endif()
endif()

# refuse(TEXT PART…): a header with this declaration must be rejected, with a message that contains these parts.
function(refuse text)
    file(WRITE "${WORK}/header.h" "/* A header. */\n\n${text}\n")
    run_failing("${TOOL}" "${WORK}/refused" 1.0 "${HEADERS}/phasetree_embree.h" "${WORK}/header.h")
    expect("${errors}" ${ARGN})
    if(EXISTS "${WORK}/refused")
        message(FATAL_ERROR "pages were written of a header that was rejected")
    endif()
endfunction()
set(declared "PHASETREE_API PhasetreeError phasetreeTry(int number)")
refuse("${declared};" "header.h:3" "phasetreeTry has no description")
refuse("/* Tries. */\n\n${declared};" "phasetreeTry has no description")
refuse("/* Tries.\n *\n * number  how often.\n * digit   of what. */\n${declared};" "\"digit\", which is none of its parameters")
refuse("/* Tries. */\nPHASETREE_API int phasetreeTry(void);" "phasetreeTry does not say what it returns")
refuse("typedef struct PhasetreeTry {\n    int number;\n} PhasetreeTry;" "header.h:3" "PhasetreeTry has no description")
refuse("/* Tries. */\n${declared}" "header.h:4" "this declaration has no end")

# A correct header must be accepted.
file(WRITE "${WORK}/header.h" "/* A header. */

/* How to try. */
typedef struct PhasetreeTry {
    int number; /* 1 to 3; of what */
    void (*tell)(void* userPtr, int number);
} PhasetreeTry;

static inline void phasetreeInitTry(PhasetreeTry* settings) { settings->number = 1; }

/* Tries \\ as often as *told*.
 *
 * settings, done   the settings, and a call of yours;
 *                  it is called at the end.
 *
 * returns  how often it went well
 * PHASETREE_ERROR_CANCELLED  never
 *
 * .5 is no number of times. */
PHASETREE_API int phasetreeTryHard(const PhasetreeTry* settings, void (*done)(void* userPtr));
PHASETREE_API int phasetreeTryHarder(const PhasetreeTry* settings, void (*done)(void* userPtr));
")
run("${TOOL}" "${WORK}/made" 1.0 "${HEADERS}/phasetree_embree.h" "${WORK}/header.h")
set(PAGES "${WORK}/made/man3")
read_page(phasetreeTryHarder)
expect("${page}" "phasetreeTryHard, phasetreeTryHarder \\- Tries \\e as often as told\n"
    "int phasetreeTryHarder(\n    const PhasetreeTry* settings,\n    void (*done)(void* userPtr));\n"
    ".PP\nTries \\e as often as \\fItold\\fR.\n.PP\n\\&.5 is no number of times.\n"
    ".TP\n.B settings, done\nthe settings, and a call of yours; it is called at the end.\n"
    ".SH \"RETURN VALUE\"\n.PP\nHow often it went well\n.SH \"ERRORS\"\n.TP\n.B PHASETREE_ERROR_CANCELLED\nnever\n"
    ".BR PhasetreeTry (3)")
read_page(phasetreeInitTry)
expect("${page}" "PhasetreeTry, phasetreeInitTry \\- How to try\n" "} PhasetreeTry;\n" "void phasetreeInitTry(PhasetreeTry* settings);")
file(READ "${WORK}/made/reference.html" html)
expect("${html}" "<dt><code>settings</code></dt>" "<em>told</em>" "<a href=\"#PhasetreeTry\"><code>PhasetreeTry</code></a>")
file(REMOVE_RECURSE "${WORK}")
