// The one place where tinyobjloader, which is a header, is compiled: Debian's library of it is a shared one
// only, which the packaged tool would need.
#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>
