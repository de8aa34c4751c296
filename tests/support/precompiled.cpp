// SPDX-License-Identifier: GPL-3.0-or-later
// Owns headers that tests share precompiled; there is nothing to run.
int main() { return 0; }
