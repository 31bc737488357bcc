// Where the tests find the project's files.
#pragma once

#include <string>

// The repository's folder as it was built, without a slash at its end.
std::string source_directory();
