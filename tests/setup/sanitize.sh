# The engine's own rooms under the address and undefined-behaviour sanitizers. Sourced by tests/run.sh.

run_sanitized() {
  local folder="$build/sanitize" python="$build/venv/bin/python"
  cmake -S "$repository" -B "$folder/engine" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DSTILLWATER_SANITIZE=ON \
    -DPython_EXECUTABLE="$python" -Dpybind11_DIR="$("$python" -m pybind11 --cmakedir)" >"$folder.log" 2>&1 &&
    cmake --build "$folder/engine" --parallel 2 >>"$folder.log" 2>&1 || { tail -20 "$folder.log"; return 1; }
  rm -rf "$folder/site" && mkdir -p "$folder/site"
  cp -r "$repository/native/python/stillwater" "$folder/site/"
  cp "$folder"/engine/native/bindings/_stillwater*.so "$folder/site/stillwater/"
  local rooms=("$@")
  [ ${#rooms[@]} = 0 ] && rooms=(tests/core tests/picture tests/patches tests/layers tests/motion tests/flow tests/appearance tests/example tests/frame)
  # Python itself and the libraries keep memory to the end of the process: leaks are not what is looked for here.
  LD_PRELOAD="$(g++ -print-file-name=libasan.so) $(g++ -print-file-name=libstdc++.so)" PYTHONPATH="$folder/site" \
    ASAN_OPTIONS=detect_leaks=0:halt_on_error=1 UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1 \
    STILLWATER_SANITIZED=1 "$python" -m pytest -q --import-mode=importlib -p no:cacheprovider --timeout=600 "${rooms[@]}"
}
