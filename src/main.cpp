#include "cli/run.h"

int main(int argc, char** argv) { return skinforge::run(argc, argv); }
