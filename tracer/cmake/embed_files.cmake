# Writes a C++ file with the content of text files: a function that returns a list of {name, text}.
#
#     cmake -DOUT=… -DFOLDER=… -DNAMES=a,b -DHEADER=view/page_files.hpp -DNAMESPACE=phasetree::tracer::view
#         -DTYPE=PageFile -DFUNCTION=page_files -P embed_files.cmake
string(REPLACE "," ";" names "${NAMES}")
set(text "// Made of the files in ${FOLDER} by tracer/cmake/embed_files.cmake.\n#include \"${HEADER}\"\n\n")
string(APPEND text "namespace ${NAMESPACE} {\n\nnamespace {\n\nconstexpr ${TYPE} files[] = {\n")
foreach(name ${names})
    file(READ "${FOLDER}/${name}" content)
    string(APPEND text "    {\"${name}\", R\"embedded(${content})embedded\"},\n")
endforeach()
string(APPEND text "};\n\n}  // namespace\n\nstd::span<const ${TYPE}> ${FUNCTION}() {\n    return files;\n}\n\n")
string(APPEND text "}  // namespace ${NAMESPACE}\n")
file(WRITE "${OUT}" "${text}")
