#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| kerrscope_fuzz::provenance(bytes));
