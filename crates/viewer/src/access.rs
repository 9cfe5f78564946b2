//! Who may ask: only who knows the token, by an address that is really this server's, from a page that this
//! server has sent.
//!
//! A page of another site can make the browser ask a server of this machine; it can't read the token, its
//! `Origin` is another one, and a name that was bent to this machine (DNS rebinding) is none of the hosts
//! that are accepted here: `localhost` and plain addresses.

use axum::http::HeaderMap;
use axum::http::header::{HOST, ORIGIN};
use std::net::IpAddr;

/// Bytes of a token that is made here.
const BYTES: usize = 16;
/// A token that the user chooses has at least so many characters.
pub(crate) const LEAST: usize = 16;

/// A token that no one can guess.
pub(crate) fn token() -> Result<String, getrandom::Error> {
    let mut bytes = [0; BYTES];
    getrandom::fill(&mut bytes)?;
    Ok(bytes.iter().map(|byte| format!("{byte:02x}")).collect())
}

/// Whether a token can stand in an address and is long enough not to be guessed.
pub(crate) fn is_token(text: &str) -> bool {
    (LEAST..=128).contains(&text.len()) && text.chars().all(|c| c.is_ascii_alphanumeric() || "-_".contains(c))
}

/// Whether two tokens are the same; takes as long for any two of one length.
pub(crate) fn is_same(one: &str, other: &str) -> bool {
    one.len() == other.len() && one.bytes().zip(other.bytes()).fold(0, |difference, (a, b)| difference | (a ^ b)) == 0
}

/// Why a request is refused; none: it is not. A request that changes something must say where it comes from.
pub(crate) fn refusal(headers: &HeaderMap, port: u16, must_report_origin: bool) -> Option<&'static str> {
    let text = |name| headers.get(name).map(|value| value.to_str().unwrap_or_default());
    let Some(host) = text(HOST).filter(|host| is_own(host, port)) else {
        return Some("the host of the address is not this machine: open the address that the program has printed");
    };
    match text(ORIGIN) {
        Some(origin) if origin == format!("http://{host}") => None,
        Some(_) => Some("the request comes from a page of another site"),
        None if must_report_origin => Some("the request does not say from which page it comes"),
        None => None,
    }
}

/// Whether a host with its port can be this server: `localhost` or an address, no other name.
fn is_own(host: &str, port: u16) -> bool {
    let Some((name, own)) = host.rsplit_once(':') else { return false };
    let address = name.strip_prefix('[').and_then(|name| name.strip_suffix(']')).unwrap_or(name);
    own.parse() == Ok(port) && (name == "localhost" || address.parse::<IpAddr>().is_ok())
}

#[cfg(test)]
mod tests {
    use super::*;
    use axum::http::HeaderValue;

    fn refused(host: &'static str, origin: Option<&'static str>, must: bool) -> bool {
        let mut headers = HeaderMap::new();
        headers.insert(HOST, HeaderValue::from_static(host));
        if let Some(origin) = origin {
            headers.insert(ORIGIN, HeaderValue::from_static(origin));
        }
        refusal(&headers, 8080, must).is_some()
    }

    #[test]
    fn only_this_machine_is_a_host() {
        assert!(["127.0.0.1:8080", "localhost:8080", "[::1]:8080", "192.168.1.7:8080"].iter().all(|host| !refused(host, None, false)));
        assert!(
            ["evil.example:8080", "127.0.0.1:81", "127.0.0.1", "localhost.evil.example:8080", ":8080", ""]
                .iter()
                .all(|host| refused(host, None, false))
        );
    }

    #[test]
    fn only_own_pages_may_ask_and_who_changes_something_must_say_so() {
        assert!(!refused("127.0.0.1:8080", Some("http://127.0.0.1:8080"), true));
        assert!(refused("127.0.0.1:8080", Some("http://localhost:8080"), true));
        assert!(refused("127.0.0.1:8080", Some("https://evil.example"), false));
        assert!(refused("127.0.0.1:8080", Some("null"), false));
        assert!(refused("127.0.0.1:8080", None, true));
    }

    #[test]
    fn tokens_differ_and_are_long() {
        let [one, other] = [token().unwrap(), token().unwrap()];
        assert!(is_token(&one) && one.len() == 32 && one != other);
        assert!(is_same(&one, &one.clone()) && !is_same(&one, &other) && !is_same(&one, &one[1..]));
        assert!(!is_token("short") && !is_token("with/slash-and-more-letters"));
    }
}
