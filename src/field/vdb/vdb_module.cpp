#include "field/vdb/vdb_module.h"

extern "C" {
extern const skinforge::VdbFunctions skinforge_vdb_functions;
const skinforge::VdbFunctions skinforge_vdb_functions = {skinforge::vdb::to_vdb};
}
