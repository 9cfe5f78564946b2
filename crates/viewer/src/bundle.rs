//! The built page: part of the program, so that it needs no files beside it.

use axum::body::Body;
use axum::http::header::{CACHE_CONTROL, CONTENT_SECURITY_POLICY, CONTENT_TYPE, REFERRER_POLICY, X_CONTENT_TYPE_OPTIONS};
use axum::http::{HeaderName, Response, StatusCode};

/// Name, type and contents.
const FILES: &[(&str, &str, &[u8])] = &[
    ("", "text/html; charset=utf-8", include_bytes!("../bundle/index.html")),
    ("app.js", "text/javascript; charset=utf-8", include_bytes!("../bundle/app.js")),
    ("app.css", "text/css; charset=utf-8", include_bytes!("../bundle/app.css")),
    ("favicon.svg", "image/svg+xml", include_bytes!("../bundle/favicon.svg")),
];

/// What the page may do: nothing but talk to its own server.
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; media-src blob:; connect-src 'self'; \
                      font-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// Headers of every answer: the address holds the token and goes nowhere else.
pub(crate) const HEADERS: [(HeaderName, &str); 4] = [
    (CONTENT_SECURITY_POLICY, POLICY),
    (REFERRER_POLICY, "no-referrer"),
    (X_CONTENT_TYPE_OPTIONS, "nosniff"),
    // The next program at this address is another one.
    (CACHE_CONTROL, "no-store"),
];

/// An answer of this type.
pub(crate) fn answer(status: StatusCode, kind: &str, bytes: impl Into<Body>) -> Response<Body> {
    let mut response = Response::builder().status(status).header(CONTENT_TYPE, kind);
    for (name, value) in HEADERS {
        response = response.header(name, value);
    }
    response.body(bytes.into()).expect("the headers are plain ASCII")
}

/// A file of the page; none of another name.
pub(crate) fn file(name: &str) -> Option<Response<Body>> {
    FILES.iter().find(|(own, _, _)| *own == name).map(|(_, kind, bytes)| answer(StatusCode::OK, kind, *bytes))
}
