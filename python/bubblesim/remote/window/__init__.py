# SPDX-License-Identifier: BSD-3-Clause
"""The module ``window`` of the remote API: what the page of the window needs beside the functions of `sim`."""
