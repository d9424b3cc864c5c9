//! Who is answered: pages of this server alone, asked for by its own name.
//!
//! Any page in a browser can send requests to this machine, and by a name that it resolves to 127.0.0.1 it would even pass for
//! the same origin (DNS rebinding). So every request has to name this server by its number, or as localhost, and one
//! that says which page it comes from has to come from ours.

use std::net::{IpAddr, SocketAddr};
use std::sync::Arc;

use axum::extract::{Request, State};
use axum::http::header::{self, HeaderMap, HeaderName, HeaderValue};
use axum::http::{StatusCode, Uri};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};

use super::House;

/// What a browser may do with what it is sent: nothing but with what is from here.
const HEADERS: [(HeaderName, HeaderValue); 6] = [
    (
        header::CONTENT_SECURITY_POLICY,
        HeaderValue::from_static(
            "default-src 'self'; img-src 'self' blob: data:; object-src 'none'; base-uri 'none'; form-action 'none'; \
             frame-ancestors 'none'",
        ),
    ),
    (header::X_CONTENT_TYPE_OPTIONS, HeaderValue::from_static("nosniff")),
    (header::REFERRER_POLICY, HeaderValue::from_static("no-referrer")),
    (header::CACHE_CONTROL, HeaderValue::from_static("no-store")),
    (HeaderName::from_static("cross-origin-resource-policy"), HeaderValue::from_static("same-origin")),
    (HeaderName::from_static("cross-origin-opener-policy"), HeaderValue::from_static("same-origin")),
];

/// The cookie that holds the token once the page has been opened with it.
const COOKIE: &str = "kerrscope";

/// Where the server is, and what opens it.
#[derive(Clone, Debug)]
pub struct Guard {
    place: SocketAddr,
    token: Option<String>,
}

impl Guard {
    /// A server at a place, open to those who know a token if there is one.
    pub fn new(place: SocketAddr, token: Option<String>) -> Self {
        Self { place, token }
    }

    /// The address to open.
    pub fn address(&self) -> String {
        let token = self.token.as_ref().map_or_else(String::new, |token| format!("?token={token}"));
        format!("http://{}/{token}", self.place)
    }

    /// Whether a `Host` means this server. A number does if the server is there or everywhere: none but names can be made
    /// to mean something else.
    fn is_own(&self, host: &str) -> bool {
        let (name, port) = match host.rsplit_once(':') {
            Some((name, port)) if !port.ends_with(']') => (name, port.parse().ok()),
            _ => (host, Some(80)),
        };
        if port != Some(self.place.port()) {
            return false;
        }
        let own = self.place.ip();
        if name.eq_ignore_ascii_case("localhost") {
            return own.is_loopback() || own.is_unspecified();
        }
        let number = name.strip_prefix('[').and_then(|rest| rest.strip_suffix(']')).unwrap_or(name);
        number.parse::<IpAddr>().is_ok_and(|number| number == own || own.is_unspecified())
    }

    /// Why a request is refused, if it is.
    fn refusal(&self, headers: &HeaderMap, uri: &Uri) -> Option<(StatusCode, &'static str)> {
        let mut hosts = headers.get_all(header::HOST).iter();
        let host = hosts.next().and_then(|host| host.to_str().ok());
        if hosts.next().is_some() || !host.is_some_and(|host| self.is_own(host)) {
            return Some((
                StatusCode::MISDIRECTED_REQUEST,
                "this server is not called so: open the address that it printed\n",
            ));
        }
        for origin in headers.get_all(header::ORIGIN) {
            let host = origin.to_str().ok().and_then(|origin| origin.strip_prefix("http://"));
            if !host.is_some_and(|host| self.is_own(host)) {
                return Some((StatusCode::FORBIDDEN, "other pages are not answered\n"));
            }
        }
        let token = self.token.as_ref()?;
        let shown = from_query(uri).into_iter().chain(from_cookies(headers));
        // Every one is compared, and whole.
        let known = shown.fold(false, |known, shown| known | same(shown, token));
        (!known).then_some((
            StatusCode::UNAUTHORIZED,
            "open the address that the program printed, with its token\n",
        ))
    }
}

fn from_query(uri: &Uri) -> Option<&str> {
    uri.query()?.split('&').find_map(|part| part.strip_prefix("token="))
}

fn from_cookies(headers: &HeaderMap) -> impl Iterator<Item = &str> {
    let cookies = headers.get_all(header::COOKIE).iter().filter_map(|value| value.to_str().ok());
    cookies
        .flat_map(|value| value.split(';'))
        .filter_map(|pair| pair.trim().strip_prefix(COOKIE)?.strip_prefix('='))
}

/// Compares in a time that does not say where two words differ.
fn same(a: &str, b: &str) -> bool {
    a.len() == b.len() && a.bytes().zip(b.bytes()).fold(0, |differ, (a, b)| differ | (a ^ b)) == 0
}

/// Refuses strangers, and tells browsers what they may do.
pub async fn check(State(house): State<Arc<House>>, request: Request, next: Next) -> Response {
    let refusal = house.guard.refusal(request.headers(), request.uri());
    let opened = request.uri().path() == "/" && refusal.is_none();
    let mut response = match refusal {
        Some(refusal) => refusal.into_response(),
        None => next.run(request).await,
    };
    let headers = response.headers_mut();
    headers.extend(HEADERS);
    if let Some(token) = house.guard.token.as_ref().filter(|_| opened) {
        let cookie = format!("{COOKIE}={token}; HttpOnly; SameSite=Strict; Path=/");
        if let Ok(cookie) = HeaderValue::from_str(&cookie) {
            headers.insert(header::SET_COOKIE, cookie);
        }
    }
    response
}

#[cfg(test)]
mod tests {
    use super::*;

    fn guard(place: &str, token: Option<&str>) -> Guard {
        Guard::new(place.parse().unwrap(), token.map(str::to_owned))
    }

    #[test]
    fn names_of_the_server() {
        let here = guard("127.0.0.1:8080", None);
        for own in ["127.0.0.1:8080", "localhost:8080", "LOCALHOST:8080"] {
            assert!(here.is_own(own), "{own}");
        }
        for foreign in [
            "127.0.0.1",
            "127.0.0.1:80",
            "example.org:8080",
            "localhost.example.org:8080",
            "[::1]:8080",
            "",
            ":8080",
        ] {
            assert!(!here.is_own(foreign), "{foreign}");
        }
        let everywhere = guard("0.0.0.0:80", Some("abcdefgh"));
        assert!(
            everywhere.is_own("192.168.0.7")
                && everywhere.is_own("[::1]:80")
                && !everywhere.is_own("example.org")
        );
    }

    #[test]
    fn strangers_are_refused() {
        let status = |guard: &Guard, uri: &str, headers: &[(HeaderName, &str)]| {
            let mut map = HeaderMap::new();
            for (name, value) in headers {
                map.append(name, value.parse().unwrap());
            }
            guard.refusal(&map, &uri.parse().unwrap()).map(|(status, _)| status.as_u16())
        };
        let here = guard("127.0.0.1:8080", None);
        let host = (header::HOST, "127.0.0.1:8080");
        assert_eq!(status(&here, "/", std::slice::from_ref(&host)), None);
        assert_eq!(status(&here, "/", &[]), Some(421));
        assert_eq!(status(&here, "/", &[host.clone(), (header::HOST, "evil.org")]), Some(421));
        for origin in ["http://evil.org", "null", "https://127.0.0.1:8080", "http://127.0.0.1:8081"] {
            assert_eq!(status(&here, "/", &[host.clone(), (header::ORIGIN, origin)]), Some(403), "{origin}");
        }
        assert_eq!(status(&here, "/", &[host.clone(), (header::ORIGIN, "http://localhost:8080")]), None);
        let closed = guard("127.0.0.1:8080", Some("abcdefgh"));
        assert_eq!(status(&closed, "/", std::slice::from_ref(&host)), Some(401));
        assert_eq!(status(&closed, "/?token=abcdefgi", std::slice::from_ref(&host)), Some(401));
        assert_eq!(status(&closed, "/?token=abcdefgh", std::slice::from_ref(&host)), None);
        assert_eq!(status(&closed, "/socket", &[host, (header::COOKIE, "a=b; kerrscope=abcdefgh")]), None);
    }
}
